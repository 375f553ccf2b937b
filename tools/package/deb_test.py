#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests how files are distributed to the Debian packages, on small files.

tools/quality/package_test.sh installs the real packages."""

import gzip
import hashlib
import os
import pathlib
import re
import tempfile
import unittest
import zipfile

import deb
import exports
import stage

DEBIAN = pathlib.Path(deb.__file__).resolve().parent / "debian"
VERSION = (DEBIAN.parents[2] / "VERSION").read_text().strip()
TRIPLET = "x86_64-linux-gnu"
LIBRARIES = f"usr/lib/{TRIPLET}"


def files(root):
    """Returns the sorted paths of the files and links below a folder."""
    return sorted(str(path.relative_to(root)) for path in root.rglob("*")
                  if path.is_symlink() or path.is_file())


class StageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def layer(self):
        """Returns the description of a layer whose files are words."""
        for name in ("so", "a", "h"):
            (self.folder / name).write_text(name)
        return {"name": "math", "needs": [], "externals": ["eigen"],
                "defines": {"A": "1"}, "root": str(self.folder),
                "headers": {"poise/math/so3.h": "h"},
                "shared": "so", "static": "a"}

    def test_users_get_the_library_and_developers_the_rest(self):
        out = self.folder / "out"
        stage.stage_layers({"math": self.layer()}, "0.9.0", TRIPLET, out)
        self.assertEqual(files(out / "libpoise0"),
                         [f"{LIBRARIES}/libpoise_math.so.0"])
        found = files(out / "libpoise-dev")
        for path in ("usr/include/poise/math/so3.h",
                     f"{LIBRARIES}/libpoise_math.a",
                     f"{LIBRARIES}/libpoise_math.so",
                     f"{LIBRARIES}/pkgconfig/poise_math.pc",
                     f"{LIBRARIES}/cmake/poise/poiseConfig.cmake"):
            self.assertIn(path, found)
        self.assertEqual(os.readlink(
            out / "libpoise-dev" / LIBRARIES / "libpoise_math.so"),
            "libpoise_math.so.0")
        self.assertIn("prefix=/usr\n", (
            out / "libpoise-dev" / LIBRARIES / "pkgconfig/poise_math.pc"
        ).read_text())

    def test_pip_gets_no_list_of_files_that_it_could_remove(self):
        wheel = self.folder / "x.whl"
        with zipfile.ZipFile(wheel, "w") as archive:
            for name in ("poise/__init__.py", "poise-0.9.0.dist-info/METADATA",
                         "poise-0.9.0.dist-info/RECORD"):
                archive.writestr(name, "x")
        stage.stage_wheel(wheel, self.folder)
        self.assertEqual(files(self.folder / "python3-poise"), [
            "usr/lib/python3/dist-packages/poise-0.9.0.dist-info/METADATA",
            "usr/lib/python3/dist-packages/poise/__init__.py"])

    def test_documents_are_equal_each_time(self):
        changelog = self.folder / "CHANGELOG.md"
        changelog.write_text("# Changelog\n")
        contents = []
        for name in ("one", "two"):
            stage.stage_documents("libpoise0", DEBIAN, changelog,
                                  self.folder / name)
            root = self.folder / name / "libpoise0/usr/share/doc/libpoise0"
            contents.append((root / "changelog.gz").read_bytes())
            os.utime(changelog, (1, 1))
        self.assertEqual(contents[0], contents[1])
        self.assertEqual(gzip.decompress(contents[0]), b"# Changelog\n")

    def test_a_digest_for_each_file_but_those_of_the_control(self):
        for name in ("DEBIAN/control", "usr/lib/x"):
            path = self.folder / name
            path.parent.mkdir(parents=True)
            path.write_text("x")
        self.assertEqual(stage.md5sums(self.folder),
                         f"{hashlib.md5(b'x').hexdigest()}  usr/lib/x\n")

    def test_other_packages_depend_on_the_minor_version(self):
        for name in ("libpoise_hqp.so.0", "libpoise_math.so.0"):
            (self.folder / name).write_text("")
        self.assertEqual(
            stage.shlibs(self.folder, "0.9.0").splitlines()[1],
            "libpoise_math 0 libpoise0 (>= 0.9.0), libpoise0 (<< 0.10~)")
        self.assertIn("(<< 2~)", stage.shlibs(self.folder, "1.2.0"))


class DebTest(unittest.TestCase):
    def test_the_changelog_has_the_present_version(self):
        found = re.match(r"poise \((.*)\)",
                         (DEBIAN / "changelog").read_text())[1]
        deb.check_version(DEBIAN, VERSION, found)
        with self.assertRaisesRegex(
                deb.PackageError, f"{found}, must be 9-NUMBER, as in VERSION"):
            deb.check_version(DEBIAN, "9", found)
        with self.assertRaisesRegex(
                deb.PackageError, f"{found}, must be {VERSION}-99, as _DEBIAN"):
            deb.check_version(DEBIAN, VERSION, f"{VERSION}-99")

    def test_the_headers_package_needs_each_library_of_the_headers(self):
        control = (DEBIAN / "control").read_text()
        (needs,) = re.findall(
            r"^Package: libpoise-dev$.*?^Depends: (.*?)^\S", control,
            re.M | re.S)
        names = {name.split()[0] for name in needs.split(",")}
        self.assertLessEqual(
            {external.debian for external in exports.EXTERNALS.values()}, names)

    def test_a_failed_command_is_one_line(self):
        with self.assertRaisesRegex(deb.PackageError,
                                    "^ls failed with exit code 2: .*nowhere"):
            deb.run("ls", "/nowhere")

    def test_the_license_is_that_of_the_project(self):
        packaged = (DEBIAN / "copyright").read_text().replace("\n .\n", "\n\n")
        text = (DEBIAN.parents[2] / "LICENSE").read_text()
        for line in text.splitlines()[4:]:
            self.assertIn(line.strip(), packaged)


if __name__ == "__main__":
    unittest.main()
