# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares the log of poise.run() with that of the command push.

Usage: same_log_test.py PUSH
"""

import json
import os
import subprocess
import sys
import unittest

import poise

PUSH = sys.argv.pop(1)


class SameLogTest(unittest.TestCase):
    def test_run_gives_the_log_of_push(self):
        for name, time in (("stand", 0.1), ("shove", 0.3)):
            with self.subTest(name=name):
                out = os.path.join(os.environ.get("TEST_TMPDIR", "/tmp"), name)
                # Exit code 1: the robot has not recovered yet.
                printed = subprocess.run(
                    [PUSH, "--scenario", name, "--time", str(time),
                     "--no-report", "--json", "--out", out],
                    stdout=subprocess.PIPE, check=False).stdout
                scenario = poise.Scenario.load(name)
                scenario.duration = time
                self.assertEqual(poise.run(scenario).summary["log_sha256"],
                                 json.loads(printed)["log_sha256"])


if __name__ == "__main__":
    unittest.main()
