#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Makes the Debian packages of Poise from built layers and the wheel.

The folder debian/ beside this file has the files that Debian's own tools read:
dpkg-shlibdeps finds the packages that the libraries need, dpkg-gencontrol
writes the package's description, dpkg-deb packs. Equal inputs and an equal
system give equal bytes: times are those of debian/changelog.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import stage

TOOLS = {"chrpath": "chrpath", "dpkg-gencontrol": "dpkg-dev",
         "dpkg-shlibdeps": "dpkg-dev", "strip": "binutils"}


class PackageError(Exception):
    """A package that cannot be made, as one line."""


def run(*command, **options):
    """Runs a command and returns what it prints."""
    words = [str(word) for word in command]
    result = subprocess.run(words, check=False, text=True,
                            capture_output=True, **options)
    if result.returncode:
        raise PackageError(f"{words[0]} failed with exit code "
                           f"{result.returncode}: {result.stderr.strip()}")
    return result.stdout


def check_tools():
    for tool, package in TOOLS.items():
        if shutil.which(tool) is None:
            raise PackageError(f"there is no {tool} on PATH; install the "
                               f"package {package} by tools/setup.sh --package")


def check_version(debian, version, debian_version):
    """Stops if VERSION, the changelog and the names of the packages disagree."""
    said = re.match(r"poise \((.*-\d+)\)", (debian / "changelog").read_text())
    found = said[1] if said else "not of the form poise (VERSION-NUMBER)"
    if found != debian_version:
        raise PackageError(f"{debian / 'changelog'}: the first version is "
                           f"{found}, must be {debian_version}, as "
                           "_DEBIAN_VERSION of tools/package/BUILD")
    if found.rsplit("-", 1)[0] != version:
        raise PackageError(f"{debian / 'changelog'}: the first version is "
                           f"{found}, must be {version}-NUMBER, as in VERSION")


def strip(root):
    """Removes symbols that nobody links to, and the search path.

    The folder of Debian's libraries is searched anyway.
    """
    for library in stage.shared_libraries(root):
        library.chmod(0o644)
        run("strip", "--strip-unneeded", "--remove-section=.comment",
            "--remove-section=.note", library)
        run("chrpath", "--delete", library)
    for archive in root.rglob("*.a"):
        archive.chmod(0o644)
        run("strip", "--strip-debug", "--enable-deterministic-archives",
            "--remove-section=.comment", "--remove-section=.note", archive)


def write_control(package, work, debian):
    """Writes the folder DEBIAN of a package."""
    root = work / "debian" / package
    control = root / "DEBIAN"
    control.mkdir(exist_ok=True)
    for kind in ("postinst", "prerm", "triggers"):
        file = debian / f"{package}.{kind}"
        if file.exists():
            shutil.copyfile(file, control / kind)
    variables = work / f"debian/{package}.substvars"
    libraries = [] if package == stage.DEVELOPMENT else [
        path.relative_to(work) for path in stage.shared_libraries(root)]
    if libraries:
        run("dpkg-shlibdeps", f"-T{variables}", f"-x{package}", *(
            f"-e{library}" for library in libraries), cwd=work)
    (control / "md5sums").write_text(stage.md5sums(root))
    run("dpkg-gencontrol", f"-p{package}", f"-P{root}", f"-T{variables}",
        cwd=work)


def make(options, work):
    """Makes the packages in a temporary folder; returns their paths."""
    version = options.version_file.read_text().strip()
    debian = pathlib.Path(__file__).resolve().parent / "debian"
    check_version(debian, version, options.debian_version)
    folder = work / "debian"
    folder.mkdir()
    for name in ("changelog", "control"):
        shutil.copyfile(debian / name, folder / name)
    layers = {}
    for path in options.files:
        if not path.name.endswith(".layer.json"):
            continue
        layer = json.loads(path.read_text())
        layers[layer["name"]] = {**layer, "root": options.root}
    triplet = run("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()
    stage.stage_layers(layers, version, triplet, folder)
    stage.stage_wheel(options.wheel, folder)
    for package in stage.PACKAGES:
        stage.stage_documents(package, debian, options.changelog, folder)
        strip(folder / package)
    control = folder / stage.SHARED / "DEBIAN"
    control.mkdir()
    (control / "shlibs").write_text(
        stage.shlibs(folder / stage.SHARED, version))
    seconds = run("dpkg-parsechangelog", "-STimestamp", cwd=work).strip()
    for package in stage.PACKAGES:
        write_control(package, work, debian)
        stage.set_modes(folder / package)
        run("dpkg-deb", "--root-owner-group", "--threads-max=1", "-Zxz",
            "--build", folder / package, work,
            env={**os.environ, "SOURCE_DATE_EPOCH": seconds})
    return sorted(work.glob("*.deb"))


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    path = pathlib.Path
    parser.add_argument("files", type=path, nargs="+", metavar="FILE",
                        help="a file of the built layers; those named "
                        "NAME.layer.json describe a layer")
    parser.add_argument("--debian-version", required=True,
                        help="the version in the names of the packages")
    parser.add_argument("--root", default=".",
                        help="the folder that the paths in it begin at")
    for name in ("wheel", "version-file", "changelog", "out"):
        parser.add_argument("--" + name, type=path, required=True)
    return parser.parse_args(arguments)


def main(arguments):
    options = parse_arguments(arguments)
    os.umask(0o022)
    try:
        check_tools()
        with tempfile.TemporaryDirectory() as work:
            for package in make(options, pathlib.Path(work)):
                shutil.copyfile(package, options.out / package.name)
    except PackageError as error:
        return f"//tools/package:deb: {error}"
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
