#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares public_headers.bzl, the list of what is public, with the tree.

A header that appears in the list or vanishes from it is a change for users:
CHANGELOG.md names it."""

import os
import pathlib
import tempfile
import unittest

import public_headers

ROOT = pathlib.Path("WORKSPACE").resolve().parent
LIST = ROOT / "tools/rules/layers/public_headers.bzl"


class PublicHeadersTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.public = public_headers.read_list(LIST.read_text())

    def test_the_list_has_each_public_header_of_the_tree(self):
        self.assertEqual(self.public, public_headers.headers(ROOT))

    def test_public_headers_include_public_ones_only(self):
        self.assertEqual(public_headers.needed(ROOT, self.public), [])

    def test_public_headers_with_eigen_check_its_alignment(self):
        self.assertEqual(public_headers.unaligned(ROOT, self.public), [])


class RulesTest(unittest.TestCase):
    """The checks above notice what they are for."""

    def test_finds_the_headers_of_testonly_rules(self):
        build = ('poise_cc_library(\n    name = "a",\n    hdrs = ["a.h"],\n)\n\n'
                 'poise_cc_library(\n    name = "b",\n    testonly = True,\n'
                 '    hdrs = [\n        "b.h",\n        "c.h",\n    ],\n)\n')
        self.assertEqual(public_headers.test_headers(build), {"b.h", "c.h"})

    def test_reads_the_list(self):
        self.assertEqual(
            public_headers.read_list(
                'PUBLIC_HEADERS = [\n    "math/a.h",\n]\n'
                'B = [\n    "b.h",\n]\n'), ["math/a.h"])

    def test_finds_headers_that_do_not_check_the_alignment(self):
        with tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR")) as folder:
            root = pathlib.Path(folder)
            for name, text in (
                    ("a.h", "#include <Eigen/Core>\n"),
                    ("b.h", '#include "poise/a.h"\n'),
                    ("c.h", '#include "poise/a.h"\n'
                            '#include "poise/math/eigen_alignment.h"\n'),
                    ("d.h", "#include <vector>\n"),
                    ("math/eigen_alignment.h", "#include <Eigen/Core>\n")):
                (root / name).parent.mkdir(exist_ok=True)
                (root / name).write_text(text)
            self.assertEqual(public_headers.unaligned(
                root, ["d.h", "c.h", "b.h", "a.h"]), ["a.h", "b.h"])

    def test_follows_includes_through_private_headers(self):
        found = public_headers.needed(ROOT, ["hqp/fast/active_set_search.h"])
        self.assertIn("hqp/fast/working_set_problem.h", found)
        self.assertIn("hqp/fast/projected_rows.h", found)


if __name__ == "__main__":
    unittest.main()
