# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Says which file goes into which Debian package, and writes the files.

The library's packages hold the files of //tools:install, the Python package
those of the wheel.
"""

import gzip
import hashlib
import pathlib
import re
import shutil
import sys
import zipfile

sys.path.insert(0, str(
    pathlib.Path(__file__).resolve().parents[1] / "commands/install"))

import layers as installation  # noqa: E402  pylint: disable=C0413

SHARED, DEVELOPMENT, PYTHON = "libpoise0", "libpoise-dev", "python3-poise"
PACKAGES = (SHARED, DEVELOPMENT, PYTHON)
_SITE = "usr/lib/python3/dist-packages"


def package_of(path):
    """Returns the package of a file that //tools:install makes."""
    return SHARED if re.search(r"\.so\.\d+$", path) else DEVELOPMENT


def stage_layers(layers, version, triplet, folder):
    """Writes the files of all layers into folder/PACKAGE/usr."""
    entries = installation.entries(layers, version, f"lib/{triplet}", "/usr")
    for path, entry in entries.items():
        target = folder / package_of(path) / "usr" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        if entry.link:
            target.symlink_to(entry.link)
        elif entry.copy:
            shutil.copyfile(entry.copy, target)
        else:
            target.write_text(entry.text, encoding="utf-8")


def stage_wheel(wheel, folder):
    """Writes the files of the wheel into folder/PYTHON.

    Of the wheel's description only METADATA is kept. Without RECORD, pip does
    not remove files that apt has installed.
    """
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if ".dist-info/" in name and not name.endswith("/METADATA"):
                continue
            target = folder / PYTHON / _SITE / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(archive.read(name))


def _compress(source, target):
    """Writes a file as gzip, without its name and time."""
    with open(target, "wb") as file, gzip.GzipFile(
            "", "wb", 9, file, mtime=0) as packed:
        packed.write(source.read_bytes())


def stage_documents(package, debian, changelog, folder):
    """Writes the license, both changelogs and the exceptions for lintian."""
    documents = folder / package / "usr/share/doc" / package
    documents.mkdir(parents=True)
    shutil.copyfile(debian / "copyright", documents / "copyright")
    _compress(debian / "changelog", documents / "changelog.Debian.gz")
    _compress(changelog, documents / "changelog.gz")
    overrides = folder / package / "usr/share/lintian/overrides" / package
    overrides.parent.mkdir(parents=True)
    overrides.write_text("".join(
        (debian / name).read_text()
        for name in ("lintian-overrides", f"{package}.lintian-overrides")
        if (debian / name).exists()), encoding="utf-8")


def shared_libraries(root):
    """Returns the shared libraries and Python modules below a folder."""
    return sorted(path for path in root.rglob("*.so*")
                  if path.is_file() and not path.is_symlink())


def shlibs(root, version):
    """Returns the file by which other packages depend on the libraries.

    Before version 1, a minor version may change the interface.
    """
    major, minor = version.split(".")[:2]
    bound = f"{major}.{int(minor) + 1}" if major == "0" else f"{int(major) + 1}"
    names = [re.fullmatch(r"(.+)\.so\.(\d+)", path.name)
             for path in shared_libraries(root)]
    return "".join(
        f"{name[1]} {name[2]} {SHARED} (>= {version}), {SHARED} (<< {bound}~)\n"
        for name in names)


def md5sums(root):
    """Returns the digests of all files but those of the package's control."""
    lines = []
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root)
        if path.is_file() and not path.is_symlink() and (
                name.parts[0] != "DEBIAN"):
            digest = hashlib.md5(path.read_bytes()).hexdigest()
            lines.append(f"{digest}  {name}\n")
    return "".join(lines)


def set_modes(root):
    """Makes files readable by all, and folders and scripts executable."""
    for path in [root, *root.rglob("*")]:
        if not path.is_symlink():
            script = path.name in ("postinst", "prerm")
            path.chmod(0o755 if path.is_dir() or script else 0o644)
