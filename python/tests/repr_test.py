# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks the texts that Python shows for the objects of each class."""

import re
import unittest

import numpy as np

import poise

ROBOT = poise.Robot.load()


def objects():
    """Returns one object of each public class that is made in C++."""
    tree, posture = ROBOT.tree, ROBOT.posture
    zeros = np.zeros(tree.nv)
    inputs = []

    class Spin(poise.Task):
        def rows(self, input):
            inputs.append(input)
            return np.eye(1, tree.nv + 12), np.full(1, 1e4)  # Out of reach.

    task = Spin("spin", ["x"])
    state = poise.State(posture, zeros)
    controller = poise.Controller(ROBOT, tasks=[task])
    controller.start(state)
    state.time = 1e-3
    command = controller.update(state)
    hierarchy = poise.Hierarchy(2)
    hierarchy.add_level(name="limits", C=np.eye(2), upper=[1, 1])
    solver = poise.Solver(2)
    solution = solver.solve(hierarchy)
    scenario = poise.Scenario.from_dict({"duration": 0.01})
    tick = tree.tick(posture, zeros, ["torso"])
    diagnosis = poise.doctor(__file__)  # It is no URDF.
    return [
        tree.com(posture), tree.centroidal(posture, zeros),
        solution.certificate, command, controller,
        tree.derivatives(posture, zeros, zeros), diagnosis,
        diagnosis.findings[0], ROBOT.feet[0], tick.frames[0], hierarchy,
        hierarchy.levels[0], solution.levels[0],
        controller.stack["posture"].parameters, controller.report.lost[0],
        ROBOT, scenario, poise.Simulation(ROBOT, scenario),
        ROBOT.doctor().soles[0], solution, solver, controller.stack,
        controller.stack["posture"], state, task, inputs[0], tick,
        controller.report, tree]


class ReprTest(unittest.TestCase):
    def test_each_class_has_a_text_in_one_line_without_an_address(self):
        texts = {type(thing).__name__: repr(thing) for thing in objects()}
        classes = {name for name in poise.__all__
                   if isinstance(getattr(poise, name), type)}
        self.assertEqual(classes - {"InputError", "Run"}, (set(texts) - {
            "Spin"}) | {"Task"})
        for name, text in texts.items():
            with self.subTest(name=name):
                self.assertNotIn(" at 0x", text)
                self.assertNotIn("\n", text)
                self.assertLess(len(text), 1000)

    def test_texts_have_the_facts(self):
        tree, state = ROBOT.tree, poise.State(ROBOT.posture, np.zeros(56))
        state.time = 0.5
        self.assertEqual(repr(state),
                         f"<poise.State, {tree.nq} q, 56 v, time 0.5 s>")
        hierarchy = poise.Hierarchy(3)
        hierarchy.add_level(name="limits", C=np.eye(3), upper=[1, 1, 1])
        self.assertEqual(repr(hierarchy),
                         "<poise.Hierarchy, 3 variables, 1 level>")
        self.assertEqual(repr(hierarchy.levels[0]),
                         "<poise.Level 'limits', 0 equalities, 3 inequalities>")
        posture = poise.Controller(ROBOT).stack["posture"]
        posture.enabled, posture.weight = False, 2
        self.assertEqual(
            repr(posture), "<poise.StackTask 'posture', off, level "
            f"{posture.level}, weight 2>")
        com = tree.com(tree.integrate(ROBOT.posture, np.ones(tree.nv), 0.3))
        shown = re.fullmatch(r"<poise.CenterOfMass at \((.*), (.*), (.*)\) m>",
                             repr(com))
        np.testing.assert_allclose(np.array(shown.groups(), float), com.p,
                                   rtol=1e-4)

    def test_names_with_new_lines_and_quotes_stay_in_one_line(self):
        for name in ("a\nb", "it's", '"', "a\\"):
            self.assertEqual(repr(poise.Task(name, ["x"])),
                             f"<poise.Task {name!r}>")

    def test_an_object_in_use_says_so(self):
        texts = []

        class Watch(poise.Task):
            def rows(self, input):
                for thing in (controller, controller_stack, posture,
                              parameters):
                    texts.append(repr(thing))
                return np.eye(1, ROBOT.tree.nv + 12), np.zeros(1)

        controller = poise.Controller(ROBOT, tasks=[Watch("watch", ["x"])])
        controller_stack = controller.stack
        posture = controller_stack["posture"]
        parameters = posture.parameters
        state = poise.State(ROBOT.posture, np.zeros(ROBOT.tree.nv))
        controller.start(state)
        state.time = 1e-3
        controller.update(state)
        self.assertEqual(texts[-4:], [
            f"<poise.{name}, in use>" for name in
            ("Controller", "Stack", "StackTask", "Parameters")])


if __name__ == "__main__":
    unittest.main()
