#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

import os
import pathlib
import tempfile
import unittest

import mutants
from ledger import (
    EQUIVALENT, SURVIVED, UNEXPLAINED, Counts, Entry, Ledger, add_up, digest_of,
)

_CODE = """// Copyright.
int Add(int a, int b) { return a + b; }
int Double(int a) { return 2 * a; }
"""


def _pool(text=_CODE, path="math/a.cc"):
    return mutants.make_mutants(path, text)


def _ledger(pool):
    """Makes a ledger: one mutant of Add survived, one of Double is equivalent."""
    ledger = Ledger()
    add = [m for m in pool if m.place == "Add"]
    double = [m for m in pool if m.place == "Double"]
    ledger.entries[add[0].key] = Entry(SURVIVED, "No test adds.")
    ledger.entries[double[0].key] = Entry(EQUIVALENT, "Rounds alike.")
    ledger.counts["math", "Add"] = Counts(1, 2, len(add), digest_of(add))
    return ledger


class LedgerTest(unittest.TestCase):
    def setUp(self):
        self.pool = _pool()
        self.ledger = _ledger(self.pool)

    def read(self, text):
        with tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR")) as folder:
            path = pathlib.Path(folder, "ledger.tsv")
            path.write_text(text)
            return Ledger.read(path)

    def test_comes_back_from_its_file(self):
        with tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR")) as folder:
            path = pathlib.Path(folder, "ledger.tsv")
            self.ledger.write(path)
            read = Ledger.read(path)
        self.assertEqual(read.entries, self.ledger.entries)
        self.assertEqual(read.counts, self.ledger.counts)

    def test_refuses_a_wrong_line_and_names_it(self):
        for line, message in (
            ("Add\tab\tsurvived", "has 3 columns"),
            ("Add\tab\tsurvived\t", "must have 4 with text"),
            ("Add\tab\tdied\tWhy.", "verdict 'died'"),
            ("Add\tab\tcounts\tmath: 1 of 2", "must be LAYER"),
            ("Add\tab\tcounts\tmath: 3 of 2 of 4", "must not decrease"),
            ("Add\tab\tsurvived\tA.\nAdd\tab\tsurvived\tB.", "twice"),
        ):
            with self.assertRaisesRegex(ValueError, rf"tsv:\d: .*{message}"):
                self.read(line)

    def test_finds_what_is_stale(self):
        self.assertEqual(self.ledger.stale(self.pool), [])
        elsewhere = _pool(_CODE.replace("int b", "int c").replace("+ b", "+ c"), "math/inner/b.cc")
        self.assertEqual(self.ledger.stale(elsewhere), [])
        changed = self.ledger.stale(_pool(_CODE.replace("a + b", "a + 2 * b")))
        self.assertEqual(len(changed), 1)
        self.assertRegex(changed[0], "^Add: .*No test adds")
        gone = self.ledger.stale(_pool(_CODE.replace("Add", "Sum")))
        self.assertEqual(len(gone), 2)

    def test_tallies_killed_of_tried_of_possible(self):
        tally = self.ledger.tally(self.pool)
        add = sum(1 for m in self.pool if m.place == "Add")
        double = sum(1 for m in self.pool if m.place == "Double")
        counts, is_changed = tally["math", "Add"]
        self.assertEqual((str(counts), is_changed), (f"1 of 2 of {add}", False))
        counts, is_changed = tally["math", "Double"]  # Never tried, one equivalent.
        self.assertEqual((str(counts), is_changed), (f"0 of 0 of {double - 1}", False))
        total = add_up(counts for counts, _ in tally.values())
        self.assertEqual(str(total), f"1 of 2 of {add + double - 1}")

    def test_says_that_a_function_was_changed_since(self):
        pool = _pool(_CODE.replace("a + b", "a - b"))
        self.assertTrue(self.ledger.tally(pool)["math", "Add"][1])

    def test_records_more_than_was_known(self):
        add = [m for m in self.pool if m.place == "Add"]
        verdicts = {m: "killed" for m in add}
        verdicts[add[1]], verdicts[add[2]] = SURVIVED, "invalid"
        self.ledger.record(self.pool, verdicts.get)
        n = len(add)
        counts = self.ledger.counts["math", "Add"]
        self.assertEqual(str(counts), f"{n - 2} of {n - 1} of {n - 1}")
        self.assertNotIn(add[0].key, self.ledger.entries)
        self.assertEqual(
            self.ledger.entries[add[1].key], Entry(SURVIVED, UNEXPLAINED)
        )
        self.assertEqual(len(self.ledger.counts), 1)  # Nobody tried Double.

    def test_leaves_out_what_was_tried_before_it_was_called_equivalent(self):
        double = [m for m in self.pool if m.place == "Double"]
        verdicts = {m: "killed" for m in double}
        verdicts[double[0]] = SURVIVED
        self.ledger.record(self.pool, verdicts.get)
        n = len(double) - 1
        self.assertEqual(str(self.ledger.counts["math", "Double"]), f"{n} of {n} of {n}")

    def test_keeps_larger_counts_and_notes_a_survivor_that_died(self):
        add = [m for m in self.pool if m.place == "Add"]
        self.ledger.record(self.pool, {add[0]: "killed"}.get)
        counts = self.ledger.counts["math", "Add"]
        self.assertEqual(str(counts), f"2 of 2 of {len(add)}")
        self.assertNotIn(add[0].key, self.ledger.entries)

    def test_corrects_larger_counts_by_a_new_survivor(self):
        add = [m for m in self.pool if m.place == "Add"]
        n = len(add)
        self.ledger.record(self.pool, {add[1]: SURVIVED}.get)
        counts = self.ledger.counts["math", "Add"]
        self.assertEqual(str(counts), f"1 of 3 of {n}")  # It had not been tried.
        self.assertIn(add[1].key, self.ledger.entries)
        self.ledger.counts["math", "Add"] = counts._replace(killed=n - 1, tried=n)
        self.ledger.record(self.pool, {add[2]: SURVIVED}.get)
        counts = self.ledger.counts["math", "Add"]
        self.assertEqual(str(counts), f"{n - 2} of {n} of {n}")


if __name__ == "__main__":
    unittest.main()
