#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares the binary interface of Poise with an earlier one.

Without options, compares with the list tools/package/abi.json. Prints one
sentence for each function, class or member on which programs compiled with the
earlier interface would fail. Exit code: 0 if they keep working, 1 if something
broke or the build failed, 2 for bad input.
"""

import argparse
import json
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(
    pathlib.Path(__file__).resolve().parents[1] / "commands/install"))

import abi_compare  # noqa: E402  pylint: disable=C0413
import abi_list  # noqa: E402  pylint: disable=C0413
import layers  # noqa: E402  pylint: disable=C0413
import prefix as prefixes  # noqa: E402  pylint: disable=C0413

LIST = "tools/package/abi.json"


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"abi: {message}; --help lists the options\n")


def parse_arguments(arguments):
    parser = _Parser(prog="abi", description=__doc__, allow_abbrev=False,
                     formatter_class=argparse.RawDescriptionHelpFormatter)
    choice = parser.add_mutually_exclusive_group()
    choice.add_argument("--against", metavar="DIR",
                        help="compare with what //tools:install has put into "
                        "this prefix, in place of the list")
    choice.add_argument("--record", action="store_true",
                        help=f"write the list {LIST}; CHANGELOG.md then says "
                        "what broke")
    options = parser.parse_args(arguments)
    if options.against is not None:
        # Bazel changes the working directory.
        options.against = pathlib.Path(
            os.environ.get("BUILD_WORKING_DIRECTORY", "."),
            os.path.expanduser(options.against)).resolve()
        if not (options.against / prefixes.MANIFEST).is_file():
            parser.error(f"--against {options.against} has no "
                         f"{prefixes.MANIFEST}, must be a prefix of "
                         "//tools:install")
    return options


def present(workspace):
    """Returns the interface of the tree, which Bazel builds."""
    version = (workspace / "VERSION").read_text(encoding="utf-8").strip()
    built = layers.build(workspace, layers.NAMES, sys.argv[0])
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder, "prefix")
        prefixes.install(place, layers.entries(built, version), version)
        return abi_list.interface(place, folder)


def earlier(options, workspace):
    """Returns the interface to compare with."""
    if options.against is None:
        return json.loads((workspace / LIST).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        return abi_list.interface(options.against, folder)


def run(options):
    default = pathlib.Path(__file__).resolve().parents[2]
    workspace = pathlib.Path(
        os.environ.get("BUILD_WORKSPACE_DIRECTORY", default))
    if options.record:
        text = json.dumps(present(workspace), indent=1) + "\n"
        (workspace / LIST).write_text(text, encoding="utf-8")
        print(f"wrote {LIST}")
        return 0
    old, new = earlier(options, workspace), present(workspace)
    sentences = abi_compare.broken(old, new)
    for sentence in sentences:
        print(sentence)
    print(f"{len(sentences)} changes break programs that were compiled with "
          f"{options.against or LIST}; {abi_compare.additions(old, new)} "
          "functions and classes are new")
    return 1 if sentences else 0


def main(arguments):
    options = parse_arguments(arguments)
    if os.environ.get("POISE_PARSE_ONLY"):
        return 0
    try:
        return run(options)
    except (abi_list.AbiError, layers.BuildError) as error:
        print(f"abi: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
