# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Runs code blocks of the pages: the quickstart, the reader of log.bin, the
profile of a robot, and a commanded step.

Usage: pages_test.py PAGES.PY QUICKSTART LOG ROBOTS STEPS
"""

import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

import poise

READER, QUICKSTART, LOG, ROBOTS, STEPS = map(os.path.abspath, sys.argv[1:])


def blocks(page, language="python"):
    """Returns the blocks of a language in a page."""
    spec = importlib.util.spec_from_file_location("pages", READER)
    pages = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(pages)
    text = pathlib.Path(page).read_text(encoding="utf-8")
    return [block for _, block in pages.blocks(text, language)]


class PagesTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR"))
        self.addCleanup(place.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(place.name)

    def test_quickstart_runs(self):
        (block,) = blocks(QUICKSTART)
        names = {}
        exec(compile(block, QUICKSTART, "exec"), names)
        self.assertTrue(names["run"].recovered)
        self.assertGreater(os.path.getsize("push.png"), 10000)
        self.assertIn("<html", pathlib.Path("push.html").read_text())

    def test_reader_of_the_binary_log_agrees_with_run(self):
        (block,) = blocks(LOG)
        names = {}
        exec(compile(block, LOG, "exec"), names)
        scenario = poise.Scenario.from_dict({"duration": 0.03})
        run = poise.run(scenario, out="out", binary=True)
        rows = list(names["read_log"](os.path.join("out", "log.bin")))
        self.assertEqual(len(rows), 30)
        self.assertEqual(list(rows[0]), list(run.columns))
        np.testing.assert_array_equal(
            [row["com.z[m]"] for row in rows], run["com.z"])
        self.assertEqual([row["status"] for row in rows],
                         list(run["status"]))

    def test_profile_fits_poises_robot(self):
        (block,) = blocks(ROBOTS, "yaml")
        pathlib.Path("profile.yaml").write_text(block)
        found = poise.Robot.load()
        robot = poise.Robot.load(found.urdf, profile="profile.yaml")
        self.assertEqual([foot.name for foot in robot.feet],
                         ["left_foot", "right_foot"])
        self.assertEqual(robot.tree.num_joints, found.tree.num_joints - 1)

    def test_robot_takes_the_commanded_step(self):
        (block,) = blocks(STEPS, "yaml")
        pathlib.Path("step.yaml").write_text(block)
        run = poise.run(poise.Scenario.load("step.yaml"))
        self.assertTrue(run.recovered)
        left = poise.Robot.load().feet[0]
        self.assertEqual(left.name, "left_foot")
        end = [run[f"left_foot.{axis}"][-1] for axis in "xy"]
        np.testing.assert_allclose(end, [0.12, 0.1], atol=0.01)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
