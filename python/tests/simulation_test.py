# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Scenario, poise.Simulation and poise.run."""

import hashlib
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest
from unittest import mock

import numpy as np

import poise

ROBOT = poise.Robot.load()


def short(**values):
    """Returns a scenario of 0.2 s."""
    return poise.Scenario.from_dict({"duration": 0.2, **values})


def folder():
    """Returns a new folder for a test."""
    return tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR"))


class ScenarioTest(unittest.TestCase):
    def test_loads_by_name(self):
        self.assertIn("strong_push", poise.Scenario.names())
        scenario = poise.Scenario.load("strong_push")
        self.assertEqual(
            (scenario.name, scenario.duration, scenario.num_pushes),
            ("strong_push", 6, 1))

    def test_reads_a_dict_as_a_file(self):
        scenario = poise.Scenario.from_dict(
            {"duration": np.float64(2.5), "seed": 7, "steps": True,
             "pushes": [{"force": np.array([0, 60, 0]), "at": 0.1}]}, "mine")
        self.assertEqual((scenario.name, scenario.duration, scenario.seed,
                          scenario.steps, scenario.num_pushes),
                         ("mine", 2.5, 7, True, 1))

    def test_reads_a_path_and_shows_itself(self):
        file = pathlib.Path(ROBOT.urdf).parents[2] / "sim/scenarios/stand.yaml"

        class Path(os.PathLike):
            def __fspath__(self):
                return str(file)

        for path in (file, Path()):
            self.assertEqual(poise.Scenario.load(path).name, "stand")
        with self.assertRaisesRegex(poise.InputError, "name is b'stand'"):
            poise.Scenario.load(b"stand")
        self.assertEqual(repr(short()), "<poise.Scenario 'scenario', 0.2 s, "
                         "0 pushes>")

    def test_names_the_invalid_key(self):
        for values, message in (
                ({"duraton": 3}, "key 'duraton' is unknown"),
                ({"duration": "long"}, "'duration' is 'long'"),
                ({"duration": -1}, "duration"),
                ({"duration": object()}, "must be made of dict")):
            with self.assertRaisesRegex(poise.InputError, message):
                poise.Scenario.from_dict(values)
        with self.assertRaisesRegex(poise.InputError, "one of board,"):
            poise.Scenario.load("weekpush")
        scenario = short()
        with self.assertRaisesRegex(poise.InputError, "duration is -1"):
            scenario.duration = -1
        self.assertEqual(scenario.duration, 0.2)
        with self.assertRaisesRegex(poise.InputError, "profile is 'bang'"):
            scenario.add_push([0, 1, 0], profile="bang")
        with self.assertRaisesRegex(
                poise.InputError,
                r"force has shape \(2,\), must have shape \(3,\)"):
            scenario.add_push([0, 1])


class SimulationTest(unittest.TestCase):
    def test_a_push_is_that_of_a_scenario(self):
        scenario = short()
        scenario.add_push([0, 100, 0], at=0.05, duration=0.1)
        expected = poise.Simulation(ROBOT, scenario)
        simulation = poise.Simulation(ROBOT, short())
        simulation.push([0, 100, 0], at=0.05, duration=0.1)
        expected.step(100)
        simulation.step(100)
        np.testing.assert_array_equal(simulation.q, expected.q)
        self.assertEqual(simulation.ticks, 100)
        self.assertAlmostEqual(simulation.time, 0.1)
        self.assertEqual(simulation.status, "ok")
        self.assertGreater(simulation.v[4], 0.02)  # To the left, m/s.

    def test_a_push_between_ticks_begins_now(self):
        simulation = poise.Simulation(ROBOT, short())
        still = poise.Simulation(ROBOT, short())
        for each in simulation, still:
            each.step(20)
        np.testing.assert_array_equal(simulation.q, still.q)
        simulation.push([80, 0, 0])
        for each in simulation, still:
            each.step(20)
        self.assertGreater(simulation.com[0], still.com[0])
        with self.assertRaisesRegex(poise.InputError, "nose"):
            simulation.push([1, 0, 0], link="nose")

    def test_rejects_wrong_types(self):
        for call, message in (
                (lambda: poise.Simulation(3, short()),
                 "robot is of type int, must be a Robot"),
                (lambda: poise.Simulation(ROBOT, "stand"),
                 "scenario is of type str, must be a Scenario"),
                (lambda: poise.Controller("robot"), "robot is of type str"),
                (lambda: poise.Controller(ROBOT).update(ROBOT.posture),
                 "state is of type ndarray, must be a State"),
                (lambda: poise.Controller(ROBOT).start(None),
                 "state is of type NoneType"),
                (lambda: poise.Solver(2).solve([]),
                 "hierarchy is of type list, must be a Hierarchy"),
                (lambda: poise.Scenario.from_dict([]),
                 "values is of type list, must be a dict")):
            with self.assertRaisesRegex(poise.InputError, message):
                call()

    def test_sees_a_fall(self):
        simulation = poise.Simulation(ROBOT, short())
        simulation.push([0, 4000, 0], duration=0.3)
        self.assertFalse(simulation.has_fallen)
        simulation.step(300)
        self.assertTrue(simulation.has_fallen)

    def test_its_controller_is_the_one_in_the_loop(self):
        simulation = poise.Simulation(ROBOT, short())
        controller = simulation.controller
        controller.stack["posture"].enabled = False
        simulation.step()
        self.assertFalse(simulation.controller.stack["posture"].enabled)
        del simulation
        self.assertNotIn("posture", controller.report.residuals)

    def test_two_threads_agree_with_one(self):
        def simulate(results):
            simulation = poise.Simulation(ROBOT, short())
            simulation.step(50)
            results.append(simulation.q)

        results = []
        simulate(results)
        threads = [threading.Thread(target=simulate, args=(results,))
                   for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(results[1], results[0])
        np.testing.assert_array_equal(results[2], results[0])

    def test_has_no_values_of_a_tick_before_the_first_one(self):
        simulation = poise.Simulation(ROBOT, short())
        np.testing.assert_allclose(
            simulation.com, ROBOT.tree.com(simulation.q).p, atol=1e-12)
        for values in (simulation.cop, simulation.tau,
                       simulation.com_reference,
                       simulation.controller.report.y):
            self.assertGreater(len(values), 1)
            self.assertTrue(np.isnan(values).all())
        self.assertEqual(
            (simulation.status, simulation.controller.report.status), ("", ""))
        simulation.step()
        self.assertTrue(np.isfinite(simulation.cop).all())
        self.assertTrue(np.isfinite(simulation.controller.report.y).all())
        self.assertEqual(simulation.status, "ok")


class InterruptTest(unittest.TestCase):
    def setUp(self):
        # A shell may start tests with the signal ignored.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)

    def interrupt(self, call, has_begun):
        """Presses Ctrl-C in a call that would take hours."""
        def press():
            while not has_begun():
                time.sleep(1e-3)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=press)
        with self.assertRaises(KeyboardInterrupt):
            thread.start()
            call()
        thread.join()

    def test_ctrl_c_ends_a_step(self):
        simulation = poise.Simulation(ROBOT, short())

        def is_in_use():
            try:
                return simulation.time < 0
            except RuntimeError:
                return True

        self.interrupt(lambda: simulation.step(10**9), is_in_use)
        self.assertGreater(simulation.ticks, 0)

    def test_ctrl_c_ends_a_run(self):
        with folder() as out:
            log = pathlib.Path(out, "log.csv")
            self.interrupt(
                lambda: poise.run(short(duration=3600), ROBOT, out),
                log.exists)


def nudge():
    """Returns a scenario of 0.1 s with a push."""
    scenario = short(name="nudge", duration=0.1)
    scenario.add_push([0, 50, 0], at=0.04, duration=0.04)
    return scenario


class RunTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = poise.run(nudge(), ROBOT)

    def test_has_the_columns_of_the_log(self):
        run = self.run_
        self.assertEqual(len(run["time"]), 100)
        np.testing.assert_array_equal(run["com.x"], run["com.x[m]"])
        self.assertEqual(run["com.x"].dtype, np.float64)
        self.assertEqual(run["status"].shape, (100,))
        self.assertEqual(set(run["status"]), {"ok"})
        self.assertAlmostEqual(run["push.fy"].max(), 50)
        self.assertNotIn("com.w", run)
        with self.assertRaisesRegex(poise.InputError, "'com.w' is unknown"):
            run["com.w"]

    def test_log_has_the_hash_of_the_summary(self):
        log = (self.run_.folder / "log.csv").read_bytes()
        self.assertEqual(hashlib.sha256(log).hexdigest(),
                         self.run_.summary["log_sha256"])

    def test_repeats_to_the_bit(self):
        first = poise.run(short(duration=0.05), ROBOT)
        with folder() as out:
            again = poise.run(short(duration=0.05), ROBOT, out)
            self.assertEqual(again.summary["log_sha256"],
                             first.summary["log_sha256"])
            self.assertEqual(str(again.folder), out)
            opened = poise.Run(out)
            np.testing.assert_array_equal(opened["com.y"], again["com.y"])

    def test_explains_and_reports(self):
        self.assertIn("to the left with 50 N", self.run_.explain())
        self.assertIn("pushed with 50 N", self.run_.explain(all=True))
        self.assertIn("recovered", repr(self.run_))
        self.assertIn("nudge", str(self.run_))
        with folder() as out:
            page = self.run_.report(pathlib.Path(out) / "page.html")
            self.assertIn("<html", page.read_text(encoding="utf-8"))
        self.assertTrue(self.run_._repr_html_().startswith("<iframe srcdoc="))

    def test_a_notebook_keeps_the_report_in_the_folder(self):
        with folder() as out:
            run = poise.run(short(duration=0.01), ROBOT, out)
            page = run.report()
            self.assertEqual(page, pathlib.Path(out, "report.html"))
            page.write_text("mine", encoding="utf-8")
            self.assertIn("srcdoc", run._repr_html_())
            self.assertEqual(page.read_text(encoding="utf-8"), "mine")

    def test_the_report_of_a_temporary_run_needs_a_file(self):
        with self.assertRaisesRegex(
                poise.InputError, "file is None, must be a file"):
            poise.run(short(duration=0.01), ROBOT).report()

    def test_runs_tasks_in_python(self):
        class Still(poise.Task):
            ticks = 0

            def rows(self, input):
                self.ticks += 1
                return np.zeros((1, len(input.v) + 12)), [0]

        task = Still("still", ["still.x"])
        run = poise.run(short(duration=0.02), ROBOT, tasks=[task])
        self.assertEqual((task.ticks, len(run["time"])), (20, 20))

    def test_plots_the_default_columns_and_any_others(self):
        panels = self.run_.plot().axes
        self.assertEqual(len(panels), 3)
        line = panels[0].get_lines()[2]  # com.x, com_ref.x, com.y.
        np.testing.assert_array_equal(line.get_ydata(), self.run_["com.y"])
        # Each panel marks the push as a grey band from 40 to 80 ms.
        band = panels[2].patches[0].get_extents().transformed(
            panels[2].transData.inverted())
        np.testing.assert_allclose([band.x0, band.x1], [0.04, 0.08], atol=2e-3)
        (panel,) = self.run_.plot("com.z").axes
        self.assertIn("com.z", panel.get_ylabel())
        with self.assertRaisesRegex(poise.InputError, "'status' has texts"):
            self.run_.plot("status")
        with self.assertRaisesRegex(poise.InputError, "'com.w' is unknown"):
            self.run_.plot("com.w")

    def test_makes_a_table_of_pandas(self):
        table = self.run_.to_pandas()
        self.assertEqual(len(table), 100)
        np.testing.assert_array_equal(table["com.y[m]"], self.run_["com.y"])

    def test_needs_pandas_and_matplotlib_only_when_used(self):
        for module, call in (("pandas", self.run_.to_pandas),
                             ("matplotlib.pyplot", self.run_.plot)):
            with mock.patch.dict("sys.modules", {module: None}):
                with self.assertRaisesRegex(ImportError, "install python3-"):
                    call()

    def test_temporary_files_go_with_the_run(self):
        run = poise.run(short(duration=0.01), ROBOT)
        place = run.folder
        self.assertTrue(place.exists())
        del run
        self.assertFalse(place.exists())

    def test_rejects_wrong_types(self):
        with self.assertRaisesRegex(poise.InputError, "scenario is of type"):
            poise.run(3)
        with self.assertRaisesRegex(poise.InputError, "robot is of type int"):
            poise.run(short(), 3)
        with self.assertRaisesRegex(poise.InputError, "out is 3 of type int"):
            poise.run(short(), ROBOT, out=3)


if __name__ == "__main__":
    unittest.main()
