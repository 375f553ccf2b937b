# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks that long calls release Python's global lock (GIL).

Python never takes the lock away here, because its switch interval is a day. So
a second thread counts only while a call has released the lock.
"""

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
    page = tempfile.NamedTemporaryFile(suffix=".html").name
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
        ROBOT, scenario, str(run.folder), False, False)
    yield "columns", lambda: poise._poise._read_log(str(run.folder))
    yield "explain", lambda: poise._poise._explain(str(run.folder))
    yield "report", lambda: poise._poise._write_report(
        [str(run.folder)], page, [])


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

    def test_short_calls_keep_the_lock(self):
        # NumPy releases the lock where it converts a list; so Q is an array.
        for call in (TREE.neutral, lambda: TREE.crba(Q),
                     lambda: poise.so3.exp(V[:3])):
            self.assertIsNone(self.counter.calls_until_it_counts(call, 200))


if __name__ == "__main__":
    unittest.main()
