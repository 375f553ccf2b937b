#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Links the objects of a layer into a shared library and a static one.

The shared library exports the functions and objects that a public package
defines, and nothing else: neither a private package nor inline functions and
templates, which each program has of its own. So each symbol is exported by one
library only. It finds the other libraries beside itself, by $ORIGIN.
"""

import argparse
import os
import pathlib
import subprocess
import sys

# Types that nm prints for symbols with one definition: code, data, constants.
_STRONG = "TDBRGS"


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, fromfile_prefix_chars="@")
    for name in ("name", "version-file", "compiler", "archiver", "nm", "shared",
                 "static"):
        parser.add_argument("--" + name, required=True)
    for name in ("public", "private", "below", "link-flag"):
        parser.add_argument("--" + name, action="append", default=[])
    return parser.parse_args(arguments)


def exported_symbols(nm, objects):
    """Returns the symbols that these objects define and no other may define."""
    if not objects:
        return []
    printed = subprocess.run(
        [nm, "--defined-only", "--extern-only", "--format=posix", *objects],
        stdout=subprocess.PIPE, check=True, text=True).stdout
    symbols = set()
    for line in printed.splitlines():
        words = line.split()
        if len(words) >= 2 and words[1] in _STRONG:
            symbols.add(words[0])
    return sorted(symbols)


def version_script(symbols):
    """Returns a linker script that exports these symbols only."""
    lines = ["{"]
    if symbols:
        lines += ["global:", *(f"  {symbol};" for symbol in symbols)]
    return "\n".join([*lines, "local:", "  *;", "};", ""])


def link(options):
    major = pathlib.Path(options.version_file).read_text().split(".")[0]
    script = options.shared + ".exports"
    pathlib.Path(script).write_text(
        version_script(exported_symbols(options.nm, options.public)))
    subprocess.run(
        [options.compiler, "-shared", "-o", options.shared,
         f"-Wl,-soname,libpoise_{options.name}.so.{major}",
         f"-Wl,--version-script,{script}", "-Wl,-z,defs", "-Wl,-z,relro,-z,now",
         "-Wl,--gc-sections", "-Wl,-rpath,$ORIGIN", "-Wl,--strip-debug",
         "-Wl,--build-id=sha1", *options.public, *options.private,
         "-Wl,--as-needed", *options.below,
         *options.link_flag, "-lstdc++", "-lm"], check=True)
    os.remove(script)
    if os.path.exists(options.static):
        os.remove(options.static)
    # D: no times and owners, so that the same objects give the same bytes.
    subprocess.run(
        [options.archiver, "rcsD", options.static, *options.public,
         *options.private], check=True)


def main(arguments):
    try:
        link(parse_arguments(arguments))
    except subprocess.CalledProcessError as error:
        return f"link_layer: {error.cmd[0]} failed, exit code {error.returncode}"
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
