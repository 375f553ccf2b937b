#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests compare without any peer: messages, figures and problems."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))

import compare  # noqa: E402
import controllers  # noqa: E402
import dynamics  # noqa: E402
import families  # noqa: E402
import figures  # noqa: E402
import histograms  # noqa: E402
import problems  # noqa: E402
from peers import CONTROLLER_PEERS, PEERS  # noqa: E402

MEASURE = sys.argv.pop(1)
HQP_TICKS = sys.argv.pop(1)
MEASURE_CONTROLLERS = sys.argv.pop(1)
RECORD_STATES = sys.argv.pop(1)

TOY = {"format": "hqp-1", "variables": 1, "levels": [
    {"B": [[1]], "b": [-2]}, {"A": [[1]], "a": [-1]}]}


def run(*arguments):
    """Runs compare; returns its exit code, output and error output."""
    result = subprocess.run(
        [sys.executable, str(HERE / "compare.py"), *arguments],
        capture_output=True, text=True, check=False)
    return result.returncode, result.stdout, result.stderr


def tick(*costs, time=1.0, is_solved=True, floor=1e-6):
    return figures.Tick(time, is_solved, list(costs), [floor] * len(costs))


class MessagesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_missing_folder_is_an_error(self):
        code, _, error = run("--peers", str(self.folder / "none"))
        self.assertEqual(code, 2)
        self.assertRegex(error, r"^compare: --peers: .*/none is not a folder, "
                                r"want one with the checkouts lexls, soth, "
                                r"pinocchio, tsid\n$")

    def test_folder_is_required(self):
        code, _, error = run()
        self.assertEqual(code, 2)
        self.assertIn("--peers", error)

    def test_folder_without_a_peer_is_an_error(self):
        code, output, error = run("--peers", str(self.folder))
        self.assertEqual(code, 2)
        lines = output.splitlines()
        self.assertEqual(len(lines), len(PEERS))
        for line, peer in zip(lines, PEERS):
            self.assertIn(f"{peer.name}: ", line)
            self.assertIn(f"skipped; to compare, check out {peer.url} at "
                          f"{peer.commit}", line)
        self.assertEqual(error.count("\n"), 1)
        self.assertIn("has no peer to compare with", error)

    def test_missing_peer_is_skipped_with_a_line(self):
        proof = self.folder / "lexls" / PEERS[0].proof
        proof.parent.mkdir(parents=True)
        proof.write_text("")
        said = []
        chosen = compare.choose_peers(PEERS, self.folder, said.append)
        self.assertEqual([peer.name for peer in chosen], ["lexls"])
        self.assertEqual(len(said), 1)
        self.assertIn("soth", said[0])

    def test_measure_names_a_file_of_another_format(self):
        path = self.folder / "ticks"
        path.write_text("text")
        result = subprocess.run([MEASURE, str(path)], capture_output=True,
                                text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(
            result.stderr, f"measure: {path}: not a file of recorded ticks, "
            "want poise-ticks-1; record it again\n")

    def test_missing_problem_is_an_error(self):
        missing = str(self.folder / "none.json")
        code, _, error = run("--peers", str(self.folder), "--hqp", missing)
        self.assertEqual(code, 2)
        self.assertEqual(error, f"compare: --hqp: {missing} does not exist, "
                         "want files of the format hqp-1 or folders of them\n")

    def test_missing_robot_is_an_error(self):
        missing = str(self.folder / "none.urdf")
        code, _, error = run("--peers", str(self.folder), "--dynamics", missing)
        self.assertEqual(code, 2)
        self.assertEqual(error, f"compare: --dynamics: {missing} does not "
                         "exist, want URDF files\n")

    def test_dynamics_need_a_peer(self):
        code, output, error = run("--peers", str(self.folder), "--dynamics")
        self.assertEqual(code, 2)
        self.assertIn("check out https://github.com/stack-of-tasks/pinocchio",
                      output)
        self.assertIn("has no peer to compare with", error)

    def test_whole_ticks_need_all_checkouts_of_the_peer(self):
        tsid = CONTROLLER_PEERS[0]
        proof = self.folder / "tsid" / tsid.proof
        proof.parent.mkdir(parents=True)
        proof.write_text("")
        code, output, error = run("--peers", str(self.folder), "--tick")
        self.assertEqual(code, 2)
        lines = output.splitlines()
        self.assertEqual(len(lines), 2)
        for line, name in zip(lines, ("eiquadprog", "pinocchio")):
            self.assertIn(
                f"check out https://github.com/stack-of-tasks/{name} at", line)
        self.assertIn("has no peer to compare with", error)

    def test_measure_controllers_names_a_file_of_another_format(self):
        path = self.folder / "states"
        path.write_text("text")
        result = subprocess.run([MEASURE_CONTROLLERS, str(path), "1", "1"],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(
            result.stderr, f"measure_controllers: {path}: not a file of "
            "recorded states, want poise-states-1; record it again\n")

    def test_missing_recorder_is_an_error(self):
        with self.assertRaisesRegex(compare.InputError, "bazel run"):
            compare.record(compare.SEQUENCES[0], self.folder)


class FiguresTest(unittest.TestCase):
    def test_quantile_is_a_value(self):
        values = [4, 1, 3, 2]
        self.assertEqual(figures.quantile(values, 0.5), 2)
        self.assertEqual(figures.quantile(values, 0.51), 3)
        self.assertEqual(figures.quantile(values, 0.99), 4)
        self.assertEqual(figures.quantile(list(range(1, 401)), 0.99), 396)

    def test_reads_the_output_of_measure(self):
        self.assertEqual(
            figures.read_ticks("2.500 1 3 1e-6 4 2e-6\n1 0 nan 1\n")[0],
            figures.Tick(2.5, True, [3, 4], [1e-6, 2e-6]))

    def test_each_tick_counts_with_its_fastest_pass(self):
        passes = [[tick(1, time=4), tick(2, time=5)],
                  [tick(1, time=6), tick(2, time=3)]]
        self.assertEqual(figures.fastest(passes),
                         [tick(1, time=4), tick(2, time=3)])

    def test_first_level_that_differs_decides(self):
        floors = [1e-6] * 3
        ours = [1, 1, 1]
        for costs, sign in (
            ([1, 1, 1], 0),
            ([1.0009, 1, 0.9991], 0),
            ([1, 1.0011, 0], 1),
            ([1, 0.9989, 9], -1),
            ([math.nan, 1, 1], 1),
            ([1, math.inf, 1], 1),
        ):
            self.assertEqual(
                figures.first_difference(costs, ours, floors), sign, costs)

    def test_costs_below_the_floor_are_equal(self):
        self.assertEqual(figures.first_difference([9e-4], [0], [1]), 0)
        self.assertEqual(figures.first_difference([2e-3], [0], [1]), 1)

    def test_summarizes_ticks(self):
        ours = [tick(1), tick(1), tick(1), tick(1, is_solved=False)]
        theirs = [tick(1, time=1), tick(2, time=3), tick(0.5, time=2),
                  tick(9, time=8, is_solved=False)]
        self.assertEqual(figures.summarize(theirs, ours),
                         figures.Figures(2, 8, 8, 8, 25, 25, 25))

    def test_row_has_the_ratios_of_poise_to_the_peer(self):
        ours = figures.Figures(10, 20, 30, 25, 0, 0, 0)
        theirs = figures.Figures(40, 50, 120, 80, 1, 2, 3)
        self.assertEqual(
            figures.row("a", "b", theirs, ours),
            "| a | b | 40.0 | 50.0 | 120.0 | 2.0 | 3.0 | 1.0 | 2.0 | 3.0 "
            "| 0.25 | 0.40 | 0.25 |")
        columns = {line.count("|") for line in figures.head()}
        self.assertEqual(columns, {figures.row("a", "b", ours).count("|")})


def solved(*ticks):
    """Returns the ticks of one file from pairs (time, cost)."""
    return [tick(cost, time=time) for time, cost in ticks]


class ProblemsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def solve(self, problem, passes=()):
        """Returns the ticks of Poise for a problem and two changed copies."""
        path, ticks = self.folder / "problem.json", self.folder / "ticks"
        path.write_text(json.dumps(problem))
        compare.output_of([HQP_TICKS, path, 2, 1, ticks])
        return figures.read_ticks(compare.output_of([MEASURE, ticks, *passes]))

    def test_solves_a_problem_and_its_changed_copies(self):
        ticks = self.solve(TOY, [0])
        self.assertEqual(len(ticks), 3)
        self.assertTrue(all(tick.is_solved for tick in ticks))
        self.assertAlmostEqual(ticks[0].costs[0], 0)
        self.assertAlmostEqual(ticks[0].costs[1], 0.5)
        self.assertNotEqual(ticks[0].costs[1], ticks[1].costs[1])

    def test_passes_give_the_answers_of_a_single_pass(self):
        for once, often in zip(self.solve(TOY), self.solve(TOY, [0])):
            self.assertEqual(once.costs, often.costs)

    def test_rejects_a_file_of_another_format(self):
        with self.assertRaisesRegex(compare.InputError, "hqp-1"):
            self.solve({"format": "other"})

    def test_finds_files_in_folders(self):
        for name in ("b.json", "a.json", "c.txt"):
            (self.folder / name).write_text("")
        other = self.folder / "c.txt"
        self.assertEqual(
            [path.name for path in problems.find([self.folder, other])],
            ["a.json", "b.json", "c.txt"])

    def test_first_tick_of_each_file_is_cold(self):
        ours = [solved((9, 1), (1, 1), (2, 1)), solved((7, 1), (3, 1), (4, 1))]
        cold, warm = problems.judge(ours, ours)
        self.assertEqual(cold, problems.Result(7, True, False))
        self.assertEqual(warm, problems.Result(2, True, False))

    def test_one_wrong_tick_makes_a_result_wrong(self):
        ours = [solved((1, 1), (1, 1), (1, 1))]
        cold, warm = problems.judge([solved((1, 1), (1, 2), (1, 0.5))], ours)
        self.assertEqual(cold, problems.Result(1, True, False))
        self.assertEqual(warm, problems.Result(1, False, True))

    def test_goal_compares_with_the_fastest_peer_that_is_right(self):
        def result(time, is_right=True):
            return problems.Result(time, is_right, False)

        right, wrong = result(100), result(10, False)
        for ours, peers, variables, expected in (
            (result(105), [right, wrong], 3, "yes"),
            (result(106), [right, wrong], 3, "no"),
            (result(106), [right, wrong], 2, "yes"),
            (result(106), [right, result(200)], 3, "no"),
            (result(106), [wrong], 3, "yes"),
            (result(5, False), [right], 3, "no"),
        ):
            self.assertEqual(problems.goal(ours, peers, variables), expected)

    def test_row_leaves_out_the_ratio_to_a_wrong_answer(self):
        ours = [problems.Result(10, True, False), problems.Result(6, True, 0)]
        peer = [problems.Result(20, False, False), problems.Result(4, True, 1)]
        row = problems.row("a", ours, [peer], 3)
        self.assertEqual(row,
                         "| a | 10.0, 6.0 | -, 1.50 lower | yes, no |")
        self.assertEqual({line.count("|") for line in problems.head(["b"])},
                         {row.count("|")})

    def test_poise_certifies_one_problem_of_each_family(self):
        for family in families.FAMILIES[-2:]:
            path = self.folder / "family.json"
            families.write(family, 1, path)
            problem = json.loads(path.read_text())
            del problem["levels"][2:]
            for solved_tick in self.solve(problem):
                self.assertTrue(solved_tick.is_solved, family.name)

    def test_same_seed_gives_the_same_problem(self):
        paths = [self.folder / name for name in ("1", "2", "3")]
        for seed, path in zip((1, 1, 2), paths):
            families.write(families.FAMILIES[-1], seed, path)
        texts = [path.read_text() for path in paths]
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])


class DynamicsTest(unittest.TestCase):
    def test_row_has_the_ratio_and_the_largest_difference(self):
        results = dynamics.read("".join(
            f"{name} 1.5 {2 + number} {number}e-16\n"
            for number, name in enumerate(dynamics.FUNCTIONS)))
        row = dynamics.row("a", "b", results)
        self.assertTrue(row.startswith(
            "| a | b | 1.50 / 2.00 = 0.75 | 1.50 / 3.00 = 0.50 | "), row)
        self.assertTrue(row.endswith(" | 6e-16 |"), row)
        self.assertEqual({line.count("|") for line in dynamics.head()},
                         {row.count("|")})

    def test_the_largest_difference_is_nan_if_one_is(self):
        def largest(*differences):
            return dynamics.largest_difference({
                i: dynamics.Result(1, 1, each)
                for i, each in enumerate(differences)})
        self.assertEqual(largest(1e-15, -1, 2e-15), 2e-15)
        self.assertTrue(math.isnan(largest(1e-15, math.nan, 2e-15)))

    def test_robots_are_those_of_the_files(self):
        self.assertEqual(dynamics.robots([pathlib.Path("x/a.urdf")]),
                         [("a", "x/a.urdf")])
        self.assertEqual(len(dynamics.robots([])), len(dynamics.OUR_ROBOTS))


def controlled(*ticks):
    """Returns counted ticks from triples (time, is_solved, residual)."""
    return [controllers.Tick(*each) for each in ticks]


class ControllersTest(unittest.TestCase):
    def test_reads_the_counted_ticks_of_each_controller(self):
        text = "".join(f"{name} {i}.5 {int(i != 51)} 1e-14\n"
                       for name in ("Poise", "TSID") for i in range(52))
        self.assertEqual(controllers.NOT_COUNTED, 50)
        expected = controlled((50.5, True, 1e-14), (51.5, False, 1e-14))
        self.assertEqual(controllers.read(text),
                         {"Poise": expected, "TSID": expected})

    def test_rows_have_the_ratios_of_poise_to_the_peer(self):
        ticks = {"Poise": controlled((20, True, 1e-14), (90, True, 2e-14)),
                 "TSID": controlled((80, True, 3e-13), (100, True, 7e-14))}
        rows = controllers.rows("a", ticks, has_goal=True)
        self.assertEqual(rows, [
            "| a | Poise | 20.0 | 90.0 | 90.0 | 0 | 2e-14 |  |  |  |  |",
            "| a | TSID | 80.0 | 100.0 | 100.0 | 0 | 3e-13 | 0.250 | 0.900 "
            "| 0.900 | yes |"])
        self.assertEqual({line.count("|") for line in controllers.head()},
                         {row.count("|") for row in rows})
        self.assertTrue(controllers.rows("a", ticks, has_goal=False)[1]
                        .endswith("| 0.900 | 0.900 |  |"))

    def test_poise_solves_all_ticks_of_a_recorded_push(self):
        with tempfile.TemporaryDirectory() as folder:
            states = pathlib.Path(folder) / "states"
            compare.output_of([RECORD_STATES, 120, 1, states])
            ticks = controllers.read(compare.output_of(
                [MEASURE_CONTROLLERS, states, 1, 1]))
        self.assertEqual(list(ticks), ["Poise"])
        self.assertEqual(len(ticks["Poise"]), 400)
        self.assertTrue(all(tick.is_solved for tick in ticks["Poise"]))
        self.assertTrue(all(tick.time > 0 for tick in ticks["Poise"]))
        self.assertLessEqual(controllers.largest_residual(ticks),
                             controllers.MOST_RESIDUAL)

    def test_goal_bounds_the_median_and_the_worst(self):
        theirs = controllers.Figures(100, 100, 200, 0, 0)
        for median, worst, expected in (
            (25, 200, True), (26, 200, False), (25, 201, False),
        ):
            ours = controllers.Figures(median, 999, worst, 0, 0)
            self.assertEqual(controllers.goal(ours, theirs), expected)

    def test_goal_wants_all_ticks_solved_rightly(self):
        good = controllers.Figures(1, 1, 1, 0, 0)
        slow = controllers.Figures(100, 100, 200, 0, 0)
        self.assertTrue(controllers.goal(good, slow))
        self.assertFalse(controllers.goal(good._replace(not_solved=1), slow))
        self.assertFalse(controllers.goal(good, slow._replace(not_solved=1)))
        self.assertFalse(controllers.goal(good._replace(residual=1e-3), slow))

    def test_the_largest_residual_is_that_of_solved_ticks(self):
        ticks = {"Poise": controlled((1, True, 1e-14), (1, False, 5)),
                 "TSID": controlled((1, True, 2e-13), (1, False, math.nan))}
        self.assertEqual(controllers.largest_residual(ticks), 2e-13)
        ticks["TSID"] += controlled((1, True, math.nan))
        self.assertTrue(math.isnan(controllers.largest_residual(ticks)))

    def test_no_controller_is_right_without_a_solved_tick(self):
        ticks = {"Poise": controlled((1, False, 5))}
        self.assertEqual(controllers.largest_residual(ticks), 0)
        self.assertFalse(controllers.is_right(ticks))
        ticks = {"Poise": controlled((1, True, 1e-14), (1, False, 5))}
        self.assertTrue(controllers.is_right(ticks))
        ticks["TSID"] = controlled((1, True, 1e-3))
        self.assertFalse(controllers.is_right(ticks))


class HistogramsTest(unittest.TestCase):
    def test_counts_on_a_logarithmic_axis(self):
        bins = histograms.count([10, 10.1, 100, 0.1, 1e9])
        self.assertEqual(bins[0], 3)
        self.assertEqual(bins[histograms.BINS_PER_DECADE], 1)
        self.assertEqual(bins[-1], 1)

    def test_image_is_well_formed_and_names_all_solvers(self):
        image = histograms.draw({"a & b": {"Poise": [20, 30], "x": [99]}})
        texts = [element.text for element in ElementTree.fromstring(
            image).iter("{http://www.w3.org/2000/svg}text")]
        for words in ("a & b", "Poise", "x", "10 µs", "1 s"):
            self.assertIn(words, texts)


if __name__ == "__main__":
    unittest.main()
