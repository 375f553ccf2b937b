#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Installs Poise for programs that are built without Bazel.

Headers go to PREFIX/include/poise, one shared and one static library of each
layer to PREFIX/lib, and the files of CMake and pkg-config below. A CMake
project then uses

    find_package(poise REQUIRED COMPONENTS dynamics)
    target_link_libraries(my_program poise::dynamics)

Layers that a chosen layer needs are installed with it, and layers that the
prefix has already are installed anew, so that all are of one state of Poise.
Either everything is installed or nothing. Exit code: 0 if done, 1 if the build or
the installation failed, 2 for bad input, 130 if interrupted.
"""

import argparse
import os
import pathlib
import signal
import sys

import layers
import prefix as prefixes


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"install: {message}; --help lists the options\n")


def _layer_names(text):
    names = [name for name in text.split(",") if name]
    for name in names:
        if name not in layers.NAMES:
            raise argparse.ArgumentTypeError(
                f"'{name}' is not a layer, must be of {','.join(layers.NAMES)}")
    if not names:
        raise argparse.ArgumentTypeError(
            f"no layer, must be one or more of {','.join(layers.NAMES)}")
    return names


def parse_arguments(arguments):
    parser = _Parser(
        prog="install", description=__doc__, allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", metavar="DIR", required=True,
                        help="the folder to install into, such as "
                        "/usr/local; made if it does not exist")
    parser.add_argument("--layers", metavar="NAME,...", type=_layer_names,
                        default=list(layers.NAMES),
                        help="layers to install (default: "
                        f"{','.join(layers.NAMES)})")
    parser.add_argument("--uninstall", action="store_true",
                        help="remove all that is installed in the prefix")
    options = parser.parse_args(arguments)
    if not options.prefix:
        parser.error("--prefix is empty, must be a folder")
    # Bazel changes the working directory.
    options.prefix = pathlib.Path(os.path.abspath(os.path.join(
        os.environ.get("BUILD_WORKING_DIRECTORY", "."),
        os.path.expanduser(options.prefix))))
    if options.prefix.exists() and not options.prefix.is_dir():
        parser.error(f"--prefix {options.prefix} is a file, must be a folder")
    return options


def _workspace():
    """Returns the root of the checkout."""
    default = pathlib.Path(__file__).resolve().parents[3]
    return pathlib.Path(os.environ.get("BUILD_WORKSPACE_DIRECTORY", default))


_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def _ignore_signals():
    for number in _SIGNALS:
        signal.signal(number, signal.SIG_IGN)


def _make_interruptible():
    """Turns SIGTERM and SIGHUP into an exception, as Python does for SIGINT."""
    def stop(number, frame):
        _ignore_signals()  # A second signal must not stop the way back.
        raise KeyboardInterrupt
    for number in _SIGNALS:
        signal.signal(number, stop)


def run(options):
    if options.uninstall:
        removed, missing = prefixes.uninstall(options.prefix)
        note = f"; {missing} were not there" if missing else ""
        print(f"removed {removed} files of Poise from {options.prefix}{note}")
        return
    workspace = _workspace()
    version = (workspace / "VERSION").read_text(encoding="utf-8").strip()
    names = {*options.layers, *prefixes.installed_layers(options.prefix)}
    built = layers.build(
        workspace, [name for name in layers.NAMES if name in names],
        sys.argv[0])
    entries = layers.entries(built, version)
    entries["share/doc/poise/LICENSE"] = layers.Entry(
        copy=str(workspace / "LICENSE"))
    _make_interruptible()
    prefixes.install(options.prefix, entries, version, _ignore_signals)
    print(f"installed Poise {version} ({', '.join(built)}; {len(entries)} "
          f"files) in {options.prefix}")


def _outcome(options):
    """Returns what a failure leaves behind."""
    if options.uninstall:
        return (f"part of Poise may still be in {options.prefix}; run the "
                "command again")
    return f"nothing was installed in {options.prefix}"


def main(arguments):
    options = parse_arguments(arguments)
    if os.environ.get("POISE_PARSE_ONLY"):
        return 0
    try:
        run(options)
    except prefixes.PrefixError as error:
        print(f"install: {error}", file=sys.stderr)
        return 2
    except (layers.BuildError, prefixes.UndoError) as error:
        print(f"install: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        cure = ("; choose a --prefix that you may write to, or use sudo"
                if isinstance(error, PermissionError) else "")
        print(f"install: {error.filename2 or error.filename}: "
              f"{error.strerror}; {_outcome(options)}{cure}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"install: interrupted; {_outcome(options)}", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
