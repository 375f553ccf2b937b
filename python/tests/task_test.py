# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Task: tasks that are written in Python."""

import gc
import os
import signal
import sys
import threading
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
        for foot, frame in zip(ROBOT.feet, given.tick.frames):
            np.testing.assert_allclose(
                frame.X, ROBOT.tree.pose(ROBOT.posture, foot.frame),
                atol=1e-12)

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
                (lambda: {"B": np.zeros((3, NV + 12)), "D": 1},
                 "key 'D', must be B, b, C"),
                (lambda: {},
                 r"task 'turn': rows\(\) lacks 'B', must have the 3 rows "
                 r"\['turn.x', 'turn.y', 'turn.z'\]")):
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

    def test_missing_inequalities_end_in_the_fail_safe_command(self):
        C = np.zeros((1, NV + 12))
        for answer, lacks in (({"upper": [0]}, "lacks 'C'"),
                              ({"C": C}, "lacks 'lower' and 'upper'")):
            task = Bound()
            task.rows = lambda input, answer=answer: answer
            self.assertEqual(update(task).report.status, "fail_safe")
            self.assertIn(lacks, task.error)

    def test_rows_may_not_use_the_controller_of_their_tick(self):
        task, errors = Turn(), []
        simulation = poise.Simulation(
            ROBOT, poise.Scenario.from_dict({}), [task])

        def read():
            for what in (lambda: simulation.ticks, lambda: simulation.q,
                         lambda: simulation.controller.report):
                try:
                    what()
                except RuntimeError as error:
                    errors.append(str(error))

        def answer():
            read()
            thread = threading.Thread(target=read)
            thread.start()
            thread.join()
            return np.zeros((3, NV + 12)), np.zeros(3)

        task.answer = answer
        simulation.step()
        self.assertEqual(task.error, "")
        self.assertEqual(len(errors), 6)
        for text in errors[:3]:
            self.assertIn("in a tick: rows() must use its input", text)
        for text in errors[3:]:
            self.assertIn("in use by another thread", text)

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
                (lambda: poise.Task("a"), "task 'a' has no rows"),
                (lambda: update(poise.Task("a", ["r"], weight=-1)),
                 "weight.*-1"),
                (lambda: update(poise.Task("momentum", ["r"])),
                 "momentum.*exists already")):
            with self.assertRaisesRegex(poise.InputError, message):
                call()


class InterruptTest(unittest.TestCase):
    """Exceptions in rows() that must end the program, not one tick."""

    def setUp(self):
        # A shell may start tests with the signal ignored.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)

    def task(self, end):
        """Returns a task whose rows() calls end()."""
        task = Turn()
        task.answer = end
        return task

    def press_ctrl_c(self):
        """Presses Ctrl-C."""
        os.kill(os.getpid(), signal.SIGINT)
        return np.zeros((3, NV + 12)), np.zeros(3)

    def test_ctrl_c_ends_an_update(self):
        with self.assertRaises(KeyboardInterrupt):
            update(self.task(self.press_ctrl_c))

    def test_ctrl_c_ends_steps_at_once(self):
        task = self.task(self.press_ctrl_c)
        simulation = poise.Simulation(
            ROBOT, poise.Scenario.from_dict({}), [task])
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(100)
        self.assertEqual(simulation.ticks, 1)
        self.assertEqual(simulation.status, "fail_safe")
        task.answer = None
        simulation.step()  # Nothing is left of it.

    def test_exit_ends_a_run(self):
        with self.assertRaisesRegex(SystemExit, "3"):
            poise.run(poise.Scenario.from_dict({"duration": 0.1}), ROBOT,
                      tasks=[self.task(lambda: sys.exit(3))])


if __name__ == "__main__":
    unittest.main()
