#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests same_run on programs that write logs of a few ticks."""

import contextlib
import importlib.machinery
import importlib.util
import io
import os
import pathlib
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
loader = importlib.machinery.SourceFileLoader("same_run", str(HERE / "same_run"))
same_run = importlib.util.module_from_spec(
    importlib.util.spec_from_loader("same_run", loader))
loader.exec_module(same_run)

LOG = "time[s],com.x[m],active\n0,1.5,torque.knee.max=3\n0.001,1.6,\n"


def fake_push(folder, name, log, code=0):
    """Writes a program that writes this log, as push does."""
    path = pathlib.Path(folder, name)
    path.write_text(
        '#!/bin/bash\nwhile [ "$1" != --out ]; do shift; done\n'
        f'cat > "$2/log.csv" << END\n{log}END\nexit {code}\n')
    path.chmod(0o755)
    return str(path)


class SameRunTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.old = fake_push(self.folder.name, "old", LOG)

    def run_with(self, new_log, *options, code=0):
        new = fake_push(self.folder.name, "new", new_log, code)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            status = same_run.main([
                self.old, new, "--only", "slope-bullet-weighted", "--out",
                os.path.join(self.folder.name, "out"), *options])
        return status, printed.getvalue()

    def test_equal_logs_are_the_same(self):
        status, printed = self.run_with(LOG)
        self.assertEqual(status, 0)
        self.assertIn("1 of 1 runs are the same", printed)

    def test_last_digit_differs(self):
        status, printed = self.run_with(LOG.replace("1.6", "1.6000000000000001"))
        self.assertEqual(status, 1)
        self.assertIn("com.x[m]: 1 ticks, first 1", printed)

    def test_column_that_may_differ(self):
        log = LOG.replace("1.6", "1.7")
        self.assertEqual(self.run_with(log, "--may-differ", "com.x[m]")[0], 0)

    def test_order_of_columns_does_not_count(self):
        log = ("com.x[m],time[s],active\n1.5,0,torque.knee.max=3\n1.6,0.001,\n")
        self.assertEqual(self.run_with(log)[0], 0)

    def test_missing_column_differs(self):
        log = "time[s],com.x[m]\n0,1.5\n0.001,1.6\n"
        self.assertEqual(self.run_with(log)[0], 1)

    def test_missing_tick_differs(self):
        self.assertEqual(self.run_with("".join(LOG.splitlines(True)[:2]))[0], 1)

    def test_outcome_differs(self):
        status, printed = self.run_with(LOG, code=1)
        self.assertEqual(status, 1)
        self.assertIn("exit code 0, now 1", printed)

    def test_renamed_row(self):
        log = LOG.replace("torque.knee.max", "effort.knee.max")
        self.assertEqual(self.run_with(log)[0], 1)
        names = pathlib.Path(self.folder.name, "names.tsv")
        names.write_text("torque.knee.max\teffort.knee.max\n")
        status, _ = self.run_with(log, "--row-names", str(names))
        self.assertEqual(status, 0)

    def test_failed_run_is_an_error(self):
        with self.assertRaises(same_run.InputError):
            self.run_with(LOG, code=2)


if __name__ == "__main__":
    unittest.main()
