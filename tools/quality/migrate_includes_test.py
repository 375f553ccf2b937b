#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests migrate_includes on a small project, and its table on this tree."""

import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
loader = importlib.machinery.SourceFileLoader(
    "migrate_includes", str(HERE / "migrate_includes"))
migrate_includes = importlib.util.module_from_spec(
    importlib.util.spec_from_loader("migrate_includes", loader))
loader.exec_module(migrate_includes)


class MigrateIncludesTest(unittest.TestCase):
    def migrate(self, name, text, *options):
        """Returns the migrated text of a file, and the printed output."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, name)
            path.write_text(text)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                status = migrate_includes.main([folder, *options])
            self.assertEqual(status, 0)
            return path.read_text(), printed.getvalue()

    def test_header_that_moved(self):
        text, printed = self.migrate("a.cc", '#include "hqp/cascade.h"\n')
        self.assertEqual(text, '#include "poise/hqp/reference/cascade.h"\n')
        self.assertIn("1 files changed", printed)

    def test_header_that_stays_gets_the_prefix(self):
        text, _ = self.migrate("a.h", '  # include "math/so3.h"  // Exp\n')
        self.assertEqual(text, '  # include "poise/math/so3.h"  // Exp\n')

    def test_second_run_changes_nothing(self):
        text, printed = self.migrate("a.cc", '#include "poise/math/so3.h"\n')
        self.assertEqual(text, '#include "poise/math/so3.h"\n')
        self.assertIn("0 files changed", printed)

    def test_other_includes_stay(self):
        kept = '#include <Eigen/Core>\n#include "mathematics/so3.h"\n'
        self.assertEqual(self.migrate("a.cc", kept)[0], kept)

    def test_labels(self):
        text, _ = self.migrate(
            "BUILD", 'deps = ["@poise//hqp:cascade", "@poise//dynamics"]\n')
        self.assertEqual(
            text,
            'deps = ["@poise//hqp/reference:cascade", "@poise//dynamics"]\n')

    def test_dry_run_writes_nothing(self):
        text, printed = self.migrate(
            "a.cc", '#include "math/so3.h"\n', "--dry-run")
        self.assertEqual(text, '#include "math/so3.h"\n')
        self.assertIn("1 files would change", printed)

    def test_missing_place_is_bad_input(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(migrate_includes.main(["no-such-place"]), 2)
        self.assertEqual(said.getvalue().count("\n"), 1)

    def test_table_leads_to_headers_of_this_tree(self):
        root = (HERE / "migrate_includes").resolve().parents[2]
        table = migrate_includes.read_table(HERE / "moved.tsv")
        self.assertGreater(len(table["include"]), 30)
        for old, new in table["include"].items():
            self.assertTrue((root / new).is_file(), new)
            self.assertFalse((root / old).exists(), old)


if __name__ == "__main__":
    unittest.main()
