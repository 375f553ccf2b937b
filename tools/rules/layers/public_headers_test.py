#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares public_headers.bzl, the list of what is public, with the tree.

A header that appears in the list or vanishes from it is a change for users:
CHANGELOG.md names it."""

import pathlib
import unittest

import public_headers

ROOT = pathlib.Path("WORKSPACE").resolve().parent
LIST = ROOT / "tools/rules/layers/public_headers.bzl"


class PublicHeadersTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.public, self.private = public_headers.read_list(LIST.read_text())

    def test_the_list_has_each_public_header_of_the_tree(self):
        self.assertEqual(self.public, public_headers.headers(ROOT))

    def test_the_list_has_the_private_headers_that_public_ones_include(self):
        self.assertEqual(self.private,
                         public_headers.needed(ROOT, self.public))

    def test_private_headers_are_of_the_private_folders(self):
        # Above all, no public header includes a test helper.
        for name in self.private:
            self.assertTrue(name.startswith(public_headers.PRIVATE), name)


class RulesTest(unittest.TestCase):
    """The checks above notice what they are for."""

    def test_finds_the_headers_of_testonly_rules(self):
        build = ('poise_cc_library(\n    name = "a",\n    hdrs = ["a.h"],\n)\n\n'
                 'poise_cc_library(\n    name = "b",\n    testonly = True,\n'
                 '    hdrs = [\n        "b.h",\n        "c.h",\n    ],\n)\n')
        self.assertEqual(public_headers.test_headers(build), {"b.h", "c.h"})

    def test_reads_both_lists(self):
        self.assertEqual(
            public_headers.read_list(
                'A = [\n    "math/a.h",\n]\n# x\nB = [\n    "b.h",\n]\n'),
            (["math/a.h"], ["b.h"]))

    def test_follows_includes_through_private_headers(self):
        found = public_headers.needed(ROOT, ["dynamics/rnea.h"])
        self.assertIn("dynamics/simd/recursion.h", found)
        self.assertIn("dynamics/simd/lanes.h", found)


if __name__ == "__main__":
    unittest.main()
