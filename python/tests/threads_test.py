# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks that long calls release Python's global lock (GIL).

Python never takes the lock away here, because its switch interval is a day. So
a second thread counts only while a call has released the lock.
"""

import ctypes
import os
import pathlib
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import poise

ROBOT = poise.Robot.load()
TREE = ROBOT.tree
Q, V = ROBOT.posture, np.zeros(TREE.nv)
MOST = 20000  # Calls. A busy machine may not start the second thread at once.

# A chain of 80 links, whose algorithms take more than 10 us.
LINK = ('<link name="l{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" '
        'izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>')
JOINT = ('<joint name="j{1}" type="continuous"><parent link="l{0}"/>'
         '<child link="l{1}"/><axis xyz="1 0 0"/></joint>')


def large_tree():
    """Returns a tree of 80 bodies."""
    with tempfile.TemporaryDirectory(
            dir=os.environ.get("TEST_TMPDIR")) as folder:
        file = pathlib.Path(folder, "chain.urdf")
        file.write_text('<robot name="chain">' + "".join(
            LINK.format(i) + (JOINT.format(i - 1, i) if i else "")
            for i in range(80)) + "</robot>")
        return poise.Tree.load(file)


class Counter:
    """A thread that counts whenever it gets the lock."""

    def __init__(self):
        self.count = 0
        self.goes_on = True
        self.thread = threading.Thread(target=self.run)

    def run(self):
        while self.goes_on:
            self.count += 1
            time.sleep(0)  # Releases the lock, so that the test goes on.

    def calls_until_it_counts(self, call, most):
        """Returns how many calls it takes, or None if `most` do not do it."""
        before = self.count
        for number in range(1, most + 1):
            call()
            if self.count != before:
                return number
        return None


def long_calls():
    """Yields (name, call) of the calls that release the lock."""
    solver, hierarchy = poise.Solver(40), poise.Hierarchy(40)
    hierarchy.add_level(C=np.eye(40), upper=np.full(40, 0.1))
    hierarchy.add_level(B=np.eye(40), b=np.full(40, -1))
    solution = solver.solve(hierarchy)
    scenario = poise.Scenario.from_dict({"duration": 0.003})
    simulation = poise.Simulation(ROBOT, scenario)
    controller = poise.Controller(ROBOT)
    state = poise.State(Q, V)
    controller.start(state)
    run = poise.run(scenario, ROBOT)
    force = np.array([0.0, 1.0, 0.0])
    page = tempfile.NamedTemporaryFile(suffix=".html").name
    yield "explain", solution.explain
    yield "Controller", lambda: poise.Controller(ROBOT)
    yield "start", lambda: controller.start(state)
    yield "Scenario.load", lambda: poise.Scenario.load("stand")
    yield "from_dict", lambda: poise.Scenario.from_dict({})
    yield "add_push", lambda: (
        scenario.add_push(force), scenario.clear_pushes())
    yield "push", lambda: simulation.push(force, at=1e3)
    yield "with_base", lambda: TREE.with_base("fixed")
    yield "aba", lambda: TREE.aba(Q, V, V)
    yield "derivatives", lambda: TREE.derivatives(Q, V, V)
    yield "regressor", lambda: TREE.regressor(Q, V, V)
    yield "solve", lambda: solver.solve(hierarchy)
    yield "conflict", lambda: solution.conflict(1)
    yield "update", lambda: controller.update(state)
    yield "Simulation", lambda: poise.Simulation(ROBOT, scenario)
    yield "step", simulation.step
    yield "Robot.load", poise.Robot.load
    yield "Tree.load", lambda: poise.Tree.load(ROBOT.urdf)
    yield "run", lambda: poise._poise._record(
        ROBOT, scenario, str(run.folder), False, False, ())
    yield "columns", lambda: poise._poise._read_log(str(run.folder))
    yield "explain the run", lambda: poise._poise._explain(str(run.folder))
    yield "report", lambda: poise._poise._write_report(
        [str(run.folder)], page, [])


def calls_of_a_large_tree():
    """Yields (name, call) of the algorithms that take more than 10 us."""
    tree = large_tree()
    q, v = tree.neutral(), np.zeros(tree.nv)
    M = tree.crba(q)
    for name, arguments in {
            "rnea": (q, v, v), "bias": (q, v), "crba": (q,), "aba": (q, v, v),
            "pose": (q, 0), "jacobian": (q, 0), "jacobian_bias": (q, v, 0),
            "com": (q, v), "centroidal": (q, v), "kinetic_energy": (q, v),
            "potential_energy": (q,), "tick": (q, v),
            "export_mass_matrix": ("drake", q, M),
            "import_jacobian": ("drake", q, M[:6]),
            "export_bias": ("drake", q, v, M, v)}.items():
        yield name, lambda name=name, arguments=arguments: (
            getattr(tree, name)(*arguments))


class ThreadsTest(unittest.TestCase):
    def setUp(self):
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(86400)
        self.counter = Counter()
        self.counter.thread.start()
        self.addCleanup(self.stop)

    def stop(self):
        self.counter.goes_on = False
        self.counter.thread.join()

    def test_long_calls_release_the_lock(self):
        for name, call in long_calls():
            with self.subTest(name=name):
                self.assertIsNotNone(
                    self.counter.calls_until_it_counts(call, MOST))

    def test_algorithms_of_a_large_tree_release_the_lock(self):
        for name, call in calls_of_a_large_tree():
            with self.subTest(name=name):
                self.assertIsNotNone(
                    self.counter.calls_until_it_counts(call, MOST))

    def test_short_calls_keep_the_lock(self):
        # NumPy releases the lock where it converts a list; so Q is an array.
        for call in (TREE.neutral, lambda: TREE.crba(Q),
                     lambda: poise.so3.exp(V[:3])):
            self.assertIsNone(self.counter.calls_until_it_counts(call, 200))


class RunTest(unittest.TestCase):
    def test_a_run_does_not_wait_for_a_busy_thread_in_each_tick(self):
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(86400)
        seen = []
        with tempfile.TemporaryDirectory(
                dir=os.environ.get("TEST_TMPDIR")) as folder:
            summary = os.fsencode(os.path.join(folder, "summary.json"))
            exists = ctypes.PyDLL(None).access  # Keeps the lock.

            begin = threading.Event()

            def hold_the_lock():
                begin.wait()
                end = time.monotonic() + 50
                while exists(summary, 0) != 0 and time.monotonic() < end:
                    pass
                seen.append(exists(summary, 0) == 0)

            scenario = poise.Scenario.from_dict({"duration": 0.04})
            thread = threading.Thread(target=hold_the_lock)
            thread.start()
            begin.set()  # The thread gets the lock when the run releases it.
            poise.run(scenario, ROBOT, folder, meshes=False)
            thread.join()
        self.assertEqual(seen, [True])


if __name__ == "__main__":
    unittest.main()
