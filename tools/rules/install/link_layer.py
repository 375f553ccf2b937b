#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Links the objects of a layer into a shared library and a static one.

The shared library exports the functions and objects that a header of a public
package declares and its sources define. It exports neither private packages,
nor classes that a header only announces, nor inline functions and templates,
which each program has of its own. So each symbol is exported by one library
only. The library finds the other libraries beside itself, by $ORIGIN.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

# Types that nm prints for symbols with one definition: code, data, constants, and
# functions of several versions, see math/target_clones.h.
_STRONG = "TDBRGSi"


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, fromfile_prefix_chars="@")
    for name in ("name", "version-file", "compiler", "archiver", "nm", "shared",
                 "static"):
        parser.add_argument("--" + name, required=True)
    for name in ("public", "private", "header", "below", "link-flag"):
        parser.add_argument("--" + name, action="append", default=[])
    return parser.parse_args(arguments)


def _strong_symbols(nm, objects, *options):
    """Returns the symbols that these objects define and no other may define."""
    printed = subprocess.run(
        [nm, "--defined-only", "--extern-only", "--no-sort", *options,
         *objects],
        stdout=subprocess.PIPE, check=True, text=True).stdout
    found = []
    for line in printed.splitlines():
        words = line.split(maxsplit=2)
        if len(words) == 3 and words[1] in _STRONG:
            found.append(words[2])
    return found


def is_declared(name, text):
    """Whether headers declare a name as A::B::f(int), and all of its classes.

    A class that is declared without its members is private.
    """
    # "vtable for A" belongs to A, and "f(int)::table" to f.
    name = re.sub(r"\[abi:\w+\]", "", name)
    qualified = re.sub(r"^.* for ", "", name.split("(")[0]).split()[-1]
    for word in re.sub(r"<.*>", "", qualified).split("::"):
        word = word.lstrip("~")
        if word.startswith("operator"):
            continue
        if not re.search(rf"\b{word}\b", text):
            return False
        if re.search(rf"\b(?:class|struct) {word};", text) and not re.search(
                rf"\b(?:class|struct) {word}\b[^;(){{]*{{", text):
            return False
    return True


def exported_symbols(nm, objects, headers):
    """Returns the symbols of these objects that these headers declare."""
    if not objects:
        return []
    text = "".join(pathlib.Path(h).read_text(encoding="utf-8") for h in headers)
    text = re.sub(r"//.*", "", text)
    symbols = zip(_strong_symbols(nm, objects),
                  _strong_symbols(nm, objects, "--demangle"))
    return sorted({symbol for symbol, name in symbols
                   if is_declared(name, text)})


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
        version_script(exported_symbols(
            options.nm, options.public, options.header)))
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
        return (f"link_layer: {error.cmd[0]} failed with exit code "
                f"{error.returncode}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
