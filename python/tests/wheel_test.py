# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Installs the wheel into an environment, away from the build, and uses it.

Usage: wheel_test.py WHEEL FILE...
The files are those of this folder that pytest runs with the installed package.
"""

import base64
import csv
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

WHEEL, *TESTS = (pathlib.Path(path).resolve() for path in sys.argv[1:])
del sys.argv[1:]

USE = """
import sys, time
begin = time.perf_counter()
import poise
seconds = time.perf_counter() - begin
# These would take most of the time of the import.
slow = {"numpy", "matplotlib", "pandas", "scipy"} & set(sys.modules)
assert not slow, slow
assert "poise-env" in poise.__file__, poise.__file__
robot = poise.Robot.load()
assert poise.run(poise.Scenario.from_dict({"duration": 0.05}), robot).recovered
print(f"import poise: {seconds:.3f} s")
"""


class WheelTest(unittest.TestCase):
    def test_record_has_each_file_and_its_hash(self):
        with zipfile.ZipFile(WHEEL) as wheel:
            (record,) = [name for name in wheel.namelist()
                         if name.endswith(".dist-info/RECORD")]
            rows = list(csv.reader(wheel.read(record).decode().splitlines()))
            self.assertEqual([row[0] for row in rows], wheel.namelist())
            for name, said, size in rows[:-1]:
                content = wheel.read(name)
                value = base64.urlsafe_b64encode(
                    hashlib.sha256(content).digest()).decode().rstrip("=")
                self.assertEqual((said, int(size)),
                                 (f"sha256={value}", len(content)), name)

    def test_has_the_licenses_of_all_parts(self):
        with zipfile.ZipFile(WHEEL) as wheel:
            (own,) = [n for n in wheel.namelist()
                      if n.endswith(".dist-info/LICENSE")]
            (others,) = [n for n in wheel.namelist()
                         if n.endswith(".dist-info/copyright")]
            self.assertIn(b"Redistribution and use", wheel.read(own))
            for name in (b"Three.js Authors", b"Leon Sorokin",
                         b"Permission is hereby granted"):
                self.assertIn(name, wheel.read(others))

    def test_installs_and_runs_away_from_the_build(self):
        with tempfile.TemporaryDirectory(
                dir=os.environ.get("TEST_TMPDIR")) as folder:
            place = pathlib.Path(folder) / "poise-env"
            subprocess.run([sys.executable, "-m", "venv",
                            "--system-site-packages", place], check=True)
            environment = {key: value for key, value in os.environ.items()
                           if key != "PYTHONPATH"}
            install = [place / "bin/pip", "install", "--quiet", "--no-index",
                       "--no-deps", "--force-reinstall", WHEEL]
            subprocess.run(install, env=environment, check=True)
            # A wheel of the same version takes the place of the old one.
            (module,) = place.rglob("_poise.so")
            module.write_bytes(b"of an older state")
            subprocess.run(install, env=environment, check=True)
            used = subprocess.run(
                [place / "bin/python", "-c", USE], cwd=folder,
                env=environment, check=True, capture_output=True, text=True)
            print(used.stdout, end="")
            self.check_libraries(module)
            tests = pathlib.Path(folder) / "tests"
            tests.mkdir()
            for test in TESTS:
                shutil.copy(test, tests)
            tested = subprocess.run(
                [place / "bin/python", "-m", "pytest", "--quiet", tests],
                cwd=folder, env=environment, check=False, text=True,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(tested.returncode, 0, tested.stdout)
            self.assertIn(" passed", tested.stdout)

    def check_libraries(self, module):
        """Checks that the module loads Debian's libraries alone."""
        dynamic = subprocess.run(["readelf", "--dynamic", module], check=True,
                                 capture_output=True, text=True).stdout
        self.assertNotIn("RPATH", dynamic)
        self.assertNotIn("RUNPATH", dynamic)
        libraries = subprocess.run(["ldd", module], check=True,
                                   capture_output=True, text=True).stdout
        self.assertNotIn("not found", libraries)
        for line in libraries.splitlines():
            if "=>" in line:
                self.assertRegex(line, "=> /(usr/)?lib")
        symbols = subprocess.run(
            ["nm", "--dynamic", "--defined-only", module], check=True,
            capture_output=True, text=True).stdout.split()
        self.assertIn("PyInit__poise", symbols)
        self.assertEqual(
            [symbol for symbol in symbols if "poise" in symbol.lower()],
            ["PyInit__poise"])


if __name__ == "__main__":
    unittest.main()
