# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks the package, its stubs and its examples with mypy --strict.

Usage: mypy_test.py EXAMPLE...
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import poise

EXAMPLES = [str(pathlib.Path(name).resolve()) for name in sys.argv[1:]]
FOLDER = pathlib.Path(poise.__file__).parent

USER = """
import pathlib
import numpy as np
import poise

robot = poise.Robot.load()
M: np.ndarray[tuple[int, int], np.dtype[np.float64]]
nv: int = robot.tree.nv
run: poise.Run = poise.run("stand", robot)
run = poise.run(pathlib.Path("stand.yaml"))
J = robot.tree.jacobian(robot.posture, 0, axes="frame")
R = poise.so3.exp([0, 0, 1]) @ np.eye(3)
"""


def mypy(files, out):
    """Runs mypy; returns its result."""
    # SciPy and matplotlib have no stubs.
    return subprocess.run(
        ["mypy", "--strict", "--ignore-missing-imports",
         "--no-warn-unused-ignores", f"--cache-dir={out}/cache", *files],
        cwd=FOLDER.parent, capture_output=True, text=True, check=False)


class MypyTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR"))
        self.addCleanup(place.cleanup)
        self.out = pathlib.Path(place.name)

    def test_accepts_the_package_its_examples_and_a_user(self):
        user = self.out / "user.py"
        user.write_text(USER)
        self.assertGreater(len(EXAMPLES), 5)
        result = mypy([*map(str, FOLDER.glob("*.py")), *EXAMPLES, str(user)],
                      self.out)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for right, wrong, line in (("nv: int", "nv: str", 8),
                                   ('"frame"', '"base"', 11)):
            user.write_text(USER.replace(right, wrong))
            result = mypy([str(user)], self.out)
            self.assertIn(f"user.py:{line}", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
