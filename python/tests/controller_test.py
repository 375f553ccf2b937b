# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Controller and its stack."""

import unittest

import numpy as np

import poise

ROBOT = poise.Robot.load()


def standing(time=0.0):
    """Returns the state at rest in the standing posture."""
    return poise.State(ROBOT.posture, np.zeros(ROBOT.tree.nv), time)


def started():
    """Returns a controller that stands."""
    controller = poise.Controller(ROBOT)
    controller.start(standing())
    return controller


class ControllerTest(unittest.TestCase):
    def test_stands_with_the_torques_of_rnea(self):
        controller = started()
        command = controller.update(standing(1e-3))
        self.assertEqual(command.status, "ok")
        # tau = M vdot + N - sum of J' lambda, equation (10).
        report, tree = controller.report, ROBOT.tree
        vdot, wrenches = report.y[:tree.nv], report.y[tree.nv:].reshape(2, 6)
        tau = tree.rnea(ROBOT.posture, np.zeros(tree.nv), vdot)
        tick = tree.tick(ROBOT.posture, np.zeros(tree.nv),
                         [foot.frame for foot in ROBOT.feet])
        for foot, frame, wrench in zip(ROBOT.feet, tick.frames, wrenches):
            X_WC = tick.poses[foot.body] @ foot.X_BC
            to_frame = poise.se3.inverse(frame.X) @ X_WC
            force = np.kron(np.eye(2), frame.X[:3, :3]) @ (
                poise.se3.dual_adjoint(to_frame) @ wrench)
            tau -= frame.J.T @ force
        np.testing.assert_allclose(tau[:6], 0, atol=1e-6)
        np.testing.assert_allclose(command.tau, tau[6:], atol=1e-6)
        self.assertLess(report.certificate.worst, 1e-9)
        # The gap of level 1, which is met, is at most the square of rounding.
        self.assertLess(report.gap[0], 1e-9)
        self.assertTrue(np.isnan(report.gap[-1]))

    def test_moves_to_the_reference(self):
        controller = started()
        controller.com_reference = controller.com_reference - [0, 0, 0.01]
        controller.update(standing(1e-3))
        tree = ROBOT.tree
        vdot = controller.report.y[:tree.nv]
        self.assertLess((tree.com(ROBOT.posture).J @ vdot)[2], -0.1)

    def test_a_budget_cuts_ticks_off(self):
        # The CoM goes forward until limits of torques and feet are active.
        def statuses(budget):
            controller = poise.Controller(ROBOT, max_modelled_seconds=budget)
            controller.start(standing())
            found = []
            for tick in range(5):
                controller.com_reference = ROBOT.tree.com(
                    ROBOT.posture).p + [0.5 * tick, 0, 0]
                controller.update(standing(1e-3 * (tick + 1)))
                found.append((controller.report.status,
                              controller.report.modelled_seconds))
            return found

        full, cut = statuses(0), statuses(20e-6)
        self.assertNotIn("truncated", [status for status, _ in full])
        self.assertIn("truncated", [status for status, _ in cut])
        longest = [max(time for _, time in each) for each in (full, cut)]
        self.assertGreater(longest[0], longest[1])
        self.assertGreater(longest[1], 0)
        with self.assertRaisesRegex(
                poise.InputError, "max_modelled_seconds is -1.*0 or more"):
            poise.Controller(ROBOT, max_modelled_seconds=-1)

    def test_fails_safe_on_nan(self):
        controller = started()
        state = standing(1e-3)
        state.q = np.full(ROBOT.tree.nq, np.nan)
        command = controller.update(state)
        self.assertEqual(command.status, "fail_safe")
        self.assertEqual(controller.report.fail_safe_reason, "state")
        self.assertTrue(np.isfinite(command.tau).all())
        self.assertTrue((np.abs(command.tau) <= ROBOT.effort).all())

    def test_rejects_a_state_of_another_size(self):
        nq = ROBOT.tree.nq
        with self.assertRaisesRegex(
                poise.InputError,
                rf"state.q has shape \(3,\), must have shape \({nq},\)"):
            started().update(poise.State([0, 0, 0], [0, 0]))
        with self.assertRaisesRegex(poise.InputError, "com_reference has"):
            started().com_reference = [0, 0]
        with self.assertRaisesRegex(poise.InputError, "friction is -1"):
            poise.Controller(ROBOT, friction=-1)


class StackTest(unittest.TestCase):
    def test_tunes_tasks_by_name(self):
        stack = started().stack
        self.assertIn("momentum", stack)
        self.assertEqual(len(stack), len(stack.names))
        self.assertEqual(list(stack), stack.names)
        momentum = stack["momentum"]
        momentum.level, momentum.weight, momentum.enabled = 3, 2.5, False
        name = next(iter(momentum.parameters.as_dict()))
        value = momentum.parameters[name] + 1
        momentum.parameters[name] = value
        self.assertEqual(stack["momentum"].parameters[name], value)
        again = stack["momentum"]
        self.assertEqual((again.level, again.weight, again.enabled),
                         (3, 2.5, False))

    def test_parameters_are_a_mapping(self):
        parameters = started().stack["momentum"].parameters
        names = list(parameters)
        self.assertIn("kp", names)
        self.assertIn("kp", parameters)
        self.assertNotIn("x", parameters)
        self.assertEqual(len(parameters), len(names))
        self.assertEqual(list(parameters.keys()), names)
        self.assertEqual(dict(parameters), dict(parameters.items()))
        self.assertEqual(dict(parameters)["kp"], parameters["kp"])
        self.assertEqual(list(parameters.values()),
                         [parameters[name] for name in names])

    def test_a_task_that_is_off_has_no_residual(self):
        controller = started()
        controller.update(standing(1e-3))
        self.assertIn("posture", controller.report.residuals)
        controller.stack["posture"].enabled = False
        controller.update(standing(2e-3))
        self.assertNotIn("posture", controller.report.residuals)

    def test_names_valid_values(self):
        stack = started().stack
        with self.assertRaisesRegex(poise.InputError, "momentun.*momentum"):
            stack["momentun"]
        task = stack["momentum"]
        with self.assertRaisesRegex(poise.InputError, "level is 9"):
            task.level = 9
        for weight in (-1, 1e-7):
            with self.assertRaisesRegex(
                    poise.InputError, f"momentum.weight is {weight}, must"):
                task.weight = weight
        with self.assertRaisesRegex(poise.InputError, "momentum.kp is 'x'"):
            task.parameters["kp"] = "x"
        with self.assertRaisesRegex(poise.InputError, "has no parameter 'x'"):
            task.parameters["x"] = 1
        name = next(iter(task.parameters.as_dict()))
        with self.assertRaisesRegex(poise.InputError, "must be from"):
            task.parameters[name] = -1e9
        with self.assertRaisesRegex(poise.InputError, "seconds is -1"):
            stack.set_ramp(-1)


if __name__ == "__main__":
    unittest.main()
