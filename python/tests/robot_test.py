# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Robot and poise.doctor."""

import ast
import os
import pathlib
import tempfile
import unittest

import numpy as np

import poise

ROBOT = poise.Robot.load()


class RobotTest(unittest.TestCase):
    def test_stands_with_its_soles_on_the_ground(self):
        tree = ROBOT.tree
        tick = tree.tick(ROBOT.posture, np.zeros(tree.nv))
        heights = [(tick.poses[foot.body] @ foot.X_BC)[2, 3]
                   for foot in ROBOT.feet]
        # Robot::q_nominal has its soles on the ground to 5 mm.
        np.testing.assert_allclose(heights, 0, atol=5e-3)
        self.assertEqual([foot.name for foot in ROBOT.feet],
                         ["left_foot", "right_foot"])

    def test_has_limits_of_each_joint(self):
        for limits in (ROBOT.lower, ROBOT.upper, ROBOT.velocity, ROBOT.effort):
            self.assertEqual(limits.shape, (ROBOT.tree.num_joints,))
        self.assertTrue((ROBOT.lower < ROBOT.upper).all())

    def test_tree_outlives_its_robot(self):
        tree = poise.Robot.load().tree
        self.assertEqual(tree.crba(tree.neutral()).shape, (tree.nv, tree.nv))

    def test_shows_itself(self):
        self.assertEqual(repr(ROBOT), "<poise.Robot 'humanoid', 50 joints>")

    def test_tree_needs_no_feet(self):
        tree = poise.Tree.load(ROBOT.urdf)
        self.assertAlmostEqual(tree.total_mass, ROBOT.tree.total_mass)

    def test_missing_file_is_named(self):
        with self.assertRaisesRegex(poise.InputError, "none.urdf"):
            poise.Robot.load("none.urdf")
        with self.assertRaisesRegex(poise.InputError, "none.yaml"):
            poise.Robot.load(ROBOT.urdf, "none.yaml")
        with self.assertRaisesRegex(poise.InputError, "urdf is 3 of type int"):
            poise.Robot.load(3)


class DoctorTest(unittest.TestCase):
    def test_humanoid_stands(self):
        diagnosis = ROBOT.doctor()
        self.assertIs(diagnosis.stands, True)
        self.assertEqual(diagnosis.verdict, "ok")
        self.assertEqual(len(diagnosis.soles), 2)
        self.assertGreater(diagnosis.soles[0].length, 0.1)
        self.assertRegex(diagnosis.next_step,
                         r"^poise\.run\('stand', poise\.Robot\.load\('.*'\)\)$")
        ast.parse(diagnosis.next_step)
        self.assertIn("stands", str(diagnosis))
        self.assertNotIn("bazel run", str(diagnosis))
        self.assertNotIn(" --", str(diagnosis))

    def test_lists_findings_of_a_bad_file(self):
        text = pathlib.Path(ROBOT.urdf).read_text()
        with tempfile.TemporaryDirectory(
                dir=os.environ.get("TEST_TMPDIR")) as folder:
            file = pathlib.Path(folder) / "bad.urdf"
            file.write_text(text.replace("</robot>", ""))
            diagnosis = poise.doctor(file)
            again = eval(diagnosis.next_step)  # A call of poise.doctor().
        self.assertEqual(diagnosis.verdict, "reject")
        self.assertEqual(str(again), str(diagnosis))
        self.assertEqual(diagnosis.findings[0].severity, "reject")
        self.assertIsNone(diagnosis.stands)


if __name__ == "__main__":
    unittest.main()
