#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests compare without any peer: messages, exit codes and figures."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))

import compare  # noqa: E402
import figures  # noqa: E402
from peers import PEERS  # noqa: E402

MEASURE = sys.argv.pop(1)


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
                                r"want one with the checkouts lexls, soth\n$")

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
        chosen = compare.choose_peers(self.folder, said.append)
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
                         figures.Figures(2, 8, 8, 25, 25, 25))

    def test_row_has_the_ratios_of_poise_to_the_peer(self):
        ours = figures.Figures(10, 20, 30, 0, 0, 0)
        theirs = figures.Figures(40, 50, 120, 1, 2, 3)
        self.assertEqual(
            figures.row("a", "b", theirs, ours),
            "| a | b | 40.0 | 50.0 | 120.0 | 3.0 | 1.0 | 2.0 | 3.0 "
            "| 0.25 | 0.40 | 0.25 |")
        columns = {line.count("|") for line in figures.head()}
        self.assertEqual(columns, {figures.row("a", "b", ours).count("|")})


if __name__ == "__main__":
    unittest.main()
