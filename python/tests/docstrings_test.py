# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Runs the examples of the docstrings."""

import doctest
import inspect
import unittest

import numpy as np

import poise


def docstrings():
    """Yields (name, docstring) of everything public."""
    yield "poise", poise.__doc__
    for name in poise.__all__:
        thing = getattr(poise, name)
        yield name, thing.__doc__
        for member, value in getattr(thing, "__dict__", {}).items():
            if not member.startswith("_") or member == "__init__":
                yield f"{name}.{member}", inspect.getdoc(value)
    # Sphinx and help() show the docstrings of the native groups.
    for name in ("so3", "se3"):
        yield f"_poise.{name}", getattr(poise._poise, name).__doc__


def run_examples(name, text):
    """Runs the examples of a docstring; returns (examples, report)."""
    test = doctest.DocTestParser().get_doctest(
        text or "", {"np": np, "poise": poise}, name, None, 0)
    report = []
    runner = doctest.DocTestRunner(verbose=False)
    runner.run(test, out=report.append)
    return len(test.examples), "".join(report)


class DocstringsTest(unittest.TestCase):
    def test_examples_give_what_they_say(self):
        total = 0
        for name, text in docstrings():
            with self.subTest(name=name):
                count, report = run_examples(name, text)
                total += count
                self.assertEqual(report, "")
        self.assertGreater(total, 40)

    def test_the_main_classes_have_examples(self):
        for name in ("Tree", "Robot", "Hierarchy", "Solver", "Controller",
                     "Stack", "Scenario", "Simulation", "Task", "run"):
            self.assertIn(">>> ", getattr(poise, name).__doc__, name)

    def test_notices_a_wrong_result(self):
        count, report = run_examples("x", "Text.\n\n>>> 1 + 1\n3\n")
        self.assertEqual(count, 1)
        self.assertIn("Expected:\n    3\nGot:\n    2", report)


if __name__ == "__main__":
    unittest.main()
