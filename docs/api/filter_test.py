#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests the filter that prepares docstrings for Doxygen."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path("docs/api").resolve()))
import filter as docstrings  # pylint: disable=wrong-import-position


class FilterTest(unittest.TestCase):
    def expect(self, text, wanted):
        self.assertEqual(list(docstrings.converted(text.split("\n"))),
                         wanted.split("\n"))

    def test_separates_a_formula_from_the_text_before_it(self):
        self.expect("/// Computes\n///     a = b\n///     + c\n/// in m.",
                    "/// Computes\n///\n///     a = b\n///     + c\n/// in m.")

    def test_adds_the_line_below_the_head_of_a_table(self):
        self.expect("/// A table:\n/// | a | b |\n/// | 1 | 2 |",
                    "/// A table:\n///\n/// | a | b |\n/// | --- | --- |\n"
                    "/// | 1 | 2 |")

    def test_ends_the_last_parameter_before_the_text_that_follows(self):
        self.expect("/// @param q  nq, in the\n///           order of v.\n"
                    "/// Costs O(n).\nvoid F();",
                    "/// @param q  nq, in the\n///           order of v.\n"
                    "///\n/// Costs O(n).\nvoid F();")

    def test_keeps_code_and_formulas_with_an_empty_line(self):
        text = "/// Computes\n///\n///     a = b\nint x;  // | a |\n    y();"
        self.expect(text, text)


if __name__ == "__main__":
    unittest.main()
