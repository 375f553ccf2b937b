#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Packs the package poise as a wheel.

Usage: wheel.py WHEEL VERSION_FILE LICENSE COPYRIGHT FILE...

WHEEL is NAME-VERSION-TAG.whl. COPYRIGHT has the licenses of parts that others
wrote. Each FILE has a path that contains "/poise/";
its place in the wheel begins there. Equal inputs give equal bytes.
"""

import base64
import hashlib
import pathlib
import re
import sys
import zipfile

METADATA = """\
Metadata-Version: 2.1
Name: poise
Version: {version}
Summary: Momentum control of humanoids with hierarchical inverse dynamics
License: BSD-3-Clause
Requires-Python: ==3.11.*
Requires-Dist: numpy>=1.24
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: Python :: 3.11

Rigid-body dynamics, a certified hierarchical QP solver, and momentum control
of humanoids. The native module needs shared libraries of Debian 12; the page
docs/quickstart/python.md of Poise lists their packages.
"""

WHEEL = """\
Wheel-Version: 1.0
Generator: poise
Root-Is-Purelib: false
Tag: {tag}
"""


def digest(content):
    """Returns the hash of a file as RECORD has it."""
    value = base64.urlsafe_b64encode(hashlib.sha256(content).digest())
    return "sha256=" + value.decode().rstrip("=")


def place(file):
    """Returns the path of a file in the wheel."""
    return "poise/" + str(file).split("/poise/", 1)[1]


def check_version(version, files):
    """Stops if the package says another version than the file VERSION."""
    (init,) = [file for file in files if place(file) == "poise/__init__.py"]
    said = re.search(r'__version__ = "(.*)"', init.read_text())[1]
    if said != version:
        sys.exit(f"{init}: __version__ is {said}, must be {version}, as in "
                 "VERSION")


def contents(wheel, version, licenses, files):
    """Returns the files of the wheel: {path: bytes}, RECORD last."""
    name, in_name, tag = wheel.name[:-len(".whl")].split("-", 2)
    if in_name != version:
        sys.exit(f"{wheel.name}: the version is {in_name}, must be {version}, "
                 "as in VERSION")
    if tag.split("-")[0] != "cp{}{}".format(*sys.version_info[:2]):
        sys.exit(f"{wheel.name}: is not for this Python, "
                 f"{sys.version.split()[0]}")
    info = f"{name}-{version}.dist-info/"
    packed = {place(file): file.read_bytes() for file in sorted(files)}
    for file in licenses:
        packed[info + file.name] = file.read_bytes()
    packed[info + "METADATA"] = METADATA.format(version=version).encode()
    packed[info + "WHEEL"] = WHEEL.format(tag=tag).encode()
    record = "".join(f"{path},{digest(content)},{len(content)}\n"
                     for path, content in packed.items())
    packed[info + "RECORD"] = (record + f"{info}RECORD,,\n").encode()
    return packed


def main():
    wheel, version_file, license_file, copyright_file, *files = map(
        pathlib.Path, sys.argv[1:])
    version = version_file.read_text().strip()
    check_version(version, files)
    packed = contents(wheel, version, (license_file, copyright_file), files)
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in packed.items():
            entry = zipfile.ZipInfo(path)  # Its time is 1980, always.
            entry.compress_type = zipfile.ZIP_DEFLATED
            mode = 0o755 if path.endswith(".so") else 0o644
            entry.external_attr = (0o100000 | mode) << 16
            archive.writestr(entry, content)


if __name__ == "__main__":
    main()
