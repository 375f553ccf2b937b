#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Writes docs/proof.md: how the project knows that its functions are right.

Every public function of math, dynamics and hqp, with a test of each kind that
reaches it, and what its mutants did when //tools:mutate tried them last
(docs/mutation.json).  A test reaches a function when it, or a helper that it
calls in its file, in a header for tests beside it or in tests/util, names it.
What no test names is proved by the nearest proved function of its layer that
leads to it, if mutants of its own die.

  bazel run //tools:proof             writes docs/proof.md
  bazel run //tools:proof -- --check  exit code 1 if a function has no proof, if
                                      none of its mutants died or was tried, if
                                      docs/proof.md says other than that, if
                                      survivors.txt does not explain a survivor,
                                      or equivalent.txt has a mutant that the
                                      code has no more
"""

import argparse
import collections
import os
import pathlib
import re
import sys

_HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(_HERE), str(_HERE.parent / "mutation")]

from evidence import KINDS, LAYERS, Workspace  # noqa: E402
from mutants import make_mutants  # noqa: E402
from survivors import explained, read_entries  # noqa: E402
from table import make_rows, read_results  # noqa: E402

# What people wrote stands above this line, what this program writes below.
_MARKER = "<!-- Below: bazel run //tools:proof -->"


def table(head, rows):
    """A table whose columns stand under each other in the file, too."""
    rows = [head, ["-"] * len(head)] + rows
    widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
    return [
        "| " + " | ".join(
            cell * width if cell == "-" else cell.ljust(width)
            for cell, width in zip(row, widths)
        ) + " |"
        for row in rows
    ]


def sums(rows, results):
    """By layer, how many functions have what, and what their mutants did."""
    lines = []
    for layer in LAYERS:
        group = [row for row in rows if row.layer == layer]
        counts = collections.Counter()
        for path, functions in results.items():
            if path.startswith(layer + "/"):
                for each in functions.values():
                    counts.update(killed=each["killed"], survived=each["survived"])
        killed, tried = counts["killed"], sum(counts.values())
        lines.append(
            [layer, str(len(group))]
            + [str(sum(1 for r in group if r.tests[kind])) for kind in KINDS]
            + [str(sum(1 for r in group if r.through)),
               f"{killed} of {tried}" + (
                   f", {100 * killed / tried:.1f} %" if tried else "")]
        )
    return lines


def page(rows, results):
    head = ["layer", "functions", *KINDS, "by another", "mutants killed"]
    lines = ["", *table(head, sums(rows, results)), ""]
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


def stale(file, rows, results):
    """Where the page differs from the table, in what a reader would rely on."""
    said, path = {}, None
    text = file.read_text().split(_MARKER)[-1] if file.is_file() else ""
    for line in text.splitlines():
        if line.startswith("### "):
            path = line[4:]
        elif line.startswith("| `") and path:
            cells = [cell.strip() for cell in line.strip("| ").split("|")]
            said[path, cells[0].strip("`")] = cells
    complaints = []
    tests = {t.name for row in rows for kind in KINDS for t in row.tests[kind]}
    for row in rows:
        cells = said.pop((row.path, row.name), None)
        if cells is None:
            complaints.append(f"{row.path}: {row.name}: is not in {file.name}")
            continue
        if cells[-1] != row.score:
            complaints.append(
                f"{row.path}: {row.name}: {file.name} has mutants '{cells[-1]}', "
                f"docs/mutation.json '{row.score}'"
            )
        for cell in cells[1:-1]:
            if re.fullmatch(r"\w+\.\w+", cell) and cell not in tests:
                complaints.append(
                    f"{row.path}: {row.name}: {file.name} names {cell}, no such test"
                )
    complaints += [
        f"{file.name} does not sum up: {cells[0]}: {cells[-1]}"
        for cells in sums(rows, results)
        if not any(
            line.startswith(f"| {cells[0]} ") and cells[-1] in line
            for line in text.splitlines()
        )
    ]
    return complaints + [
        f"{path}: {name}: is in {file.name}, but no function" for path, name in said
    ]


def unexplained(file, results):
    """Survivors of which the file says nothing, and what it says of others."""
    said = set(read_entries(file))
    survivors = {
        (path if name == "(constants)" else f"{path} {name}", s["before"], s["after"])
        for path, functions in results.items()
        for name, row in functions.items()
        for s in row.get("survivors", [])
    }
    return [
        f"{file.name} does not say why this survived: {' / '.join(s)}"
        for s in sorted(survivors - said)
    ] + [
        f"{file.name} explains what is no survivor: {' / '.join(s)}"
        for s in sorted(said - survivors)
    ]


def gone(root):
    """A mutant in equivalent.txt that the code has no more."""
    file = root / "tools/quality/mutation/equivalent.txt"
    pool = []
    for path in sorted({place.split()[0] for place, _, _ in read_entries(file)}):
        if not (root / path).is_file():
            return [f"{file.name}: no such file any more: {path}"]
        pool += make_mutants(path, (root / path).read_text())
    try:
        explained(file, pool)
    except ValueError as error:
        return [str(error)]
    return []


def main():
    parser = argparse.ArgumentParser(
        prog="proof", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    root = pathlib.Path(
        os.environ.get("BUILD_WORKSPACE_DIRECTORY")
        or pathlib.Path("WORKSPACE").resolve().parent
    )
    workspace = Workspace(root)
    rows = make_rows(workspace)
    complaints = [row.complaint for row in rows if row.complaint]
    file = root / "docs/proof.md"
    if not arguments.check:
        head = file.read_text().split(_MARKER)[0]
        file.write_text(head + _MARKER + "\n" + page(rows, read_results(workspace)))
    without = len(complaints)
    complaints += stale(file, rows, read_results(workspace))
    complaints += unexplained(
        root / "tools/quality/mutation/survivors.txt", read_results(workspace)
    )
    complaints += gone(root)
    for complaint in complaints:
        print(complaint)
    print(f"{len(rows)} public functions, {without} without proof")
    if complaints:
        print("docs/proof.md is written by: bazel run //tools:proof")
    return 1 if arguments.check and (complaints or not rows) else 0


if __name__ == "__main__":
    sys.exit(main())
