# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Task: tasks that are written in Python."""

import gc
import unittest
import weakref

import numpy as np

import poise

ROBOT = poise.Robot.load()
NV = ROBOT.tree.nv
NAMES = ["turn.x", "turn.y", "turn.z"]


class Turn(poise.Task):
    """Accelerates the base by `desired`, rad/s2; `answer` replaces the rows."""

    def __init__(self, **settings):
        super().__init__("turn", NAMES, **settings)
        self.desired = np.array([0.1, -0.2, 0.3])
        self.answer = None
        self.inputs = []

    def rows(self, input):
        self.inputs.append(input)
        if self.answer is not None:
            return self.answer()
        B = np.zeros((3, NV + 12))
        B[:, :3] = np.eye(3)
        return B, -self.desired


class Bound(poise.Task):
    """Bounds the vertical acceleration of the base from above."""

    def __init__(self):
        super().__init__("bound", inequalities=["bound.z"], level=3)

    def rows(self, input):
        C = np.zeros((1, NV + 12))
        C[0, 5] = 1
        return {"C": C, "upper": [-0.05]}


def update(*tasks):
    """Returns a controller after one tick of standing."""
    controller = poise.Controller(ROBOT, tasks=list(tasks))
    state = poise.State(ROBOT.posture, np.zeros(NV))
    controller.start(state)
    state.time = 1e-3
    controller.update(state)
    return controller


class TaskTest(unittest.TestCase):
    def test_rows_act_on_their_level(self):
        # Level 3 is above the momentum, which would resist.
        task = Turn(level=3)
        report = update(task).report
        self.assertEqual(report.status, "ok")
        np.testing.assert_allclose(report.y[:3], task.desired, atol=1e-9)
        self.assertAlmostEqual(report.residuals["turn"], 0, places=9)

    def test_inequalities_bound(self):
        report = update(Bound()).report
        self.assertLess(report.y[5], -0.05 + 1e-9)
        self.assertIn("bound.z", [row.name for row in report.active])

    def test_input_is_a_copy_of_the_tick(self):
        task = Turn()
        controller = update(task)
        del controller
        (given,) = task.inputs
        np.testing.assert_allclose(given.tick.M,
                                   ROBOT.tree.crba(ROBOT.posture), atol=1e-9)
        np.testing.assert_array_equal(given.q, ROBOT.posture)
        self.assertEqual(given.in_contact, [True, True])
        self.assertEqual(given.time, 1e-3)
        self.assertEqual(len(given.tick.frames), 2)

    def test_is_in_the_stack(self):
        controller = update(Turn(level=5, weight=2))
        task = controller.stack["turn"]
        self.assertEqual((task.level, task.weight), (5, 2))

    def test_an_exception_ends_in_the_fail_safe_command(self):
        def fail():
            raise KeyError("sensor")

        for answer, message in (
                (fail, "KeyError: 'sensor'"),
                (lambda: 3, r"rows\(\) returned int, must be"),
                (lambda: (np.eye(3), np.zeros(3)),
                 rf"B has shape \(3, 3\), must have shape \(3, {NV + 12}\)"),
                (lambda: {"D": 1}, "key 'D', must be B, b, C")):
            task = Turn()
            task.answer = answer
            controller = update(task)
            report = controller.report
            self.assertEqual((report.status, report.fail_safe_reason),
                             ("fail_safe", "no_answer"))
            self.assertRegex(task.error, message)
            # The next tick is as before.
            task.answer = None
            state = poise.State(ROBOT.posture, np.zeros(NV), 2e-3)
            command = controller.update(state)
            self.assertEqual((command.status, task.error), ("ok", ""))

    def test_without_rows_fails_safe(self):
        task = poise.Task("nothing", ["a"])
        self.assertEqual(update(task).report.status, "fail_safe")
        self.assertIn("has no method rows", task.error)

    def test_is_freed_with_its_controller(self):
        task = Turn()
        controller = update(task)
        alive = weakref.ref(task)
        del task
        gc.collect()
        self.assertIsNotNone(alive())
        del controller
        gc.collect()
        self.assertIsNone(alive())

    def test_rejects_invalid_arguments(self):
        for call, message in (
                (lambda: update(3), "entry of type int, must be of Task"),
                (lambda: poise.Controller(ROBOT, tasks=3), "tasks is of type"),
                (lambda: poise.Task("a", "abc"), "equalities is 'abc'"),
                (lambda: poise.Task("a", level=9), "level is 9"),
                (lambda: update(poise.Task("a", weight=-1)), "a"),
                (lambda: update(poise.Task("momentum")), "momentum")):
            with self.assertRaisesRegex(poise.InputError, message):
                call()


if __name__ == "__main__":
    unittest.main()
