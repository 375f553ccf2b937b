#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks the words of comments, pages and test names of the whole tree."""

import pathlib
import unicodedata
import unittest

import words

ROOT = pathlib.Path("WORKSPACE").resolve().parent

# Paths whose text is not prose of this project's rules, each with the reason.
SKIPPED = {
    "docs/notebook": "dated records",
    "docs/generated": "written by programs",
    "tools/viewer/dist": "bundled by a program",
    "tools/viewer/node_modules": "other projects",
    "tools/quality/mutation/dropped.txt": "quotes old code",
    "tools/rules/words": "lists the terms",
}

# (path, phrase) that stays, each with the reason.
EXCEPTIONS = {
    ("docs/migration.md", "apex"): "an old name of an option",
}


def files():
    """Yields the relative paths of the files with comments or prose."""
    for path in sorted(ROOT.rglob("*")):
        name = str(path.relative_to(ROOT))
        if name.startswith((".git/", "bazel-")) or not path.is_file():
            continue
        if any(name.startswith(skipped) for skipped in SKIPPED):
            continue
        if path.suffix in words.COMMENT and (
                path.suffix or path.name in ("BUILD", "WORKSPACE", "run")):
            yield name
        elif path.suffix == ".md":
            yield name


def long_comments(text):
    """Returns the numbers of comment lines wider than 80 columns."""
    def width(line):
        return sum(not unicodedata.combining(c) for c in line)
    return [number for number, line in enumerate(text.splitlines(), 1)
            if line.lstrip().startswith("//") and width(line) > 80]


class WordsTest(unittest.TestCase):
    maxDiff = None

    def test_the_tree_uses_standard_terms(self):
        messages = []
        for name in files():
            for number, complaint in words.findings(
                    name, (ROOT / name).read_text()):
                if not any(name == path and phrase in complaint
                           for path, phrase in EXCEPTIONS):
                    messages.append(f"{name}:{number}: {complaint}")
        self.assertEqual(messages, [])

    def test_each_exception_is_needed(self):
        for name, phrase in EXCEPTIONS:
            complaints = [complaint for _, complaint in words.findings(
                name, (ROOT / name).read_text())]
            self.assertTrue(any(phrase in complaint for complaint in complaints),
                            (name, phrase))

    def test_comments_of_cpp_have_at_most_80_columns(self):
        # clang-format would break tables and formulas.
        self.assertEqual(
            [f"{name}:{number}" for name in files()
             if name.endswith((".h", ".cc"))
             for number in long_comments((ROOT / name).read_text())], [])

    def test_the_tree_has_files(self):
        self.assertGreater(len(list(files())), 500)


class FindingsTest(unittest.TestCase):
    """The check notices what it is for."""

    def lines(self, name, text):
        return [number for number, _ in words.findings(name, text)]

    def test_notices_a_bad_beginning_of_a_comment_only(self):
        text = ("/// Of two rows,\n/// What is second.\nint a;  // Those.\n"
                "// Rows\n// Of a kind.\n")
        self.assertEqual(self.lines("a.h", text), [1, 3])

    def test_notices_a_term_anywhere_in_a_comment(self):
        self.assertEqual(
            self.lines("a.py", "# The foot\n# is let go.\nx = 'is let go'\n"),
            [2])

    def test_notices_a_term_in_a_page(self):
        self.assertEqual(self.lines("a.md", "The row gives way.\n"), [1])

    def test_notices_the_name_of_a_test(self):
        self.assertEqual(
            self.lines("a_test.cc", "TEST(A, FailsOnANumberThatIsNone) {\n"),
            [1])

    def test_notices_a_long_comment(self):
        fits = "/// " + 75 * "x" + "v\u0307"  # v with a dot: one column.
        self.assertEqual(
            long_comments("\n".join([fits, fits + "x", "int x;" + fits])), [2])

    def test_accepts_plain_words(self):
        self.assertEqual(
            self.lines("a.h", "/// Removes a row from the working set.\n"), [])


if __name__ == "__main__":
    unittest.main()
