#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Prints which tests reach which public function, and the results of its mutants.

The table has every public function of math, dynamics and hqp, one test of each
kind that reaches it, and its mutants: killed of tried of possible, as the ledger
of //tools:mutate has them.  A test reaches a function when the test, or a helper
that it calls in its file, in a header for tests beside it or in tests/util, names
the function.  A function that no test names is listed with the nearest tested
function of its layer that leads to it.

  bazel run //tools:proof             prints the table
  bazel run //tools:proof -- --check  prints what is missing; exit code 1 if a
                                      function has neither an oracle nor a
                                      property nor a check by Ceres, or if no
                                      tried mutant of it was killed
"""

import argparse
import collections
import os
import pathlib
import sys

_HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(_HERE), str(_HERE.parent / "mutation")]

from evidence import KINDS, LAYERS, Workspace  # noqa: E402
from ledger import Ledger, add_up  # noqa: E402
from table import make_rows, tree_tally  # noqa: E402


def table(head, rows):
    """Returns a table with aligned columns."""
    rows = [head, ["-"] * len(head)] + rows
    widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
    return [
        "| " + " | ".join(
            cell * width if cell == "-" else cell.ljust(width)
            for cell, width in zip(row, widths)
        ) + " |"
        for row in rows
    ]


def sums(rows, tally):
    """Returns the number of functions with each kind of test, and mutants, by layer."""
    lines = []
    for layer in LAYERS:
        group = [row for row in rows if row.layer == layer]
        counts = add_up(c for (l, _), (c, _) in tally.items() if l == layer)
        lines.append(
            [layer, str(len(group))]
            + [str(sum(1 for r in group if r.tests[kind])) for kind in KINDS]
            + [str(sum(1 for r in group if r.through)), str(counts)]
        )
    return lines


def page(rows, tally):
    head = ["layer", "functions", *KINDS, "by another", "mutants"]
    lines = [*table(head, sums(rows, tally)), ""]
    groups = collections.OrderedDict()
    for row in rows:
        groups.setdefault(row.path, []).append(row.cells())
    for path, cells in groups.items():
        used = [0] + [i for i in range(1, 5) if any(c[i] for c in cells)] + [5]
        head = ["function", *KINDS, "mutants"]
        lines += [f"### {path}", ""]
        lines += table([head[i] for i in used], [[c[i] for i in used] for c in cells])
        lines.append("")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(
        prog="proof", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    root = pathlib.Path(os.environ.get("BUILD_WORKSPACE_DIRECTORY") or os.getcwd())
    if not (root / "WORKSPACE").is_file():
        raise SystemExit(f"proof: {root}: no WORKSPACE here; use bazel run")
    workspace = Workspace(root)
    ledger = Ledger.read(root / "tools/quality/mutation/ledger.tsv")
    tally = tree_tally(workspace, ledger)
    rows = make_rows(workspace, tally)
    if not arguments.check:
        print(page(rows, tally))
    complaints = [row.complaint for row in rows if row.complaint]
    for complaint in complaints:
        print(complaint)
    print(f"{len(rows)} public functions, {len(complaints)} without proof")
    return 1 if arguments.check and (complaints or not rows) else 0


if __name__ == "__main__":
    sys.exit(main())
