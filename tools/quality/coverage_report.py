#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Usage: coverage_report.py EXECUTION_ROOT COUNTERS LAYER...

Sums up, by gcov, what the .gcda files below COUNTERS say of the layers' sources;
the .gcno files that belong to them are at the same place in EXECUTION_ROOT.
Called by coverage.sh."""

import collections
import json
import pathlib
import re
import subprocess
import sys

_WANTED_PERCENT = 97


def read(root, folder):
    """{file: {line: runs}}, {file: {(line, branch): runs}}"""
    lines = collections.defaultdict(collections.Counter)
    branches = collections.defaultdict(collections.Counter)
    counters = []
    for path in sorted(folder.rglob("*.gcda")):
        graph = path.with_suffix(".gcno")
        graph.unlink(missing_ok=True)
        graph.symlink_to(root / graph.relative_to(folder))
        counters.append(str(path))
    for start in range(0, len(counters), 50):
        output = subprocess.run(
            ["gcov", "--json-format", "--branch-probabilities", "--stdout"]
            + counters[start : start + 50],
            cwd=root, check=True, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, text=True,
        ).stdout
        for document in filter(None, output.split("\n")):
            for file in json.loads(document)["files"]:
                name = file["file"]
                for line in file["lines"]:
                    number = line["line_number"]
                    lines[name][number] += line["count"]
                    for i, branch in enumerate(line["branches"]):
                        if not branch["throw"]:
                            branches[name][number, i] += branch["count"]
    return lines, branches


def ranges(numbers):
    """1, 2, 3, 7  ->  "1-3, 7"."""
    parts = []
    for n in sorted(numbers):
        if parts and parts[-1][1] == n - 1:
            parts[-1][1] = n
        else:
            parts.append([n, n])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in parts)


def share(counts):
    """(run, all, percent)"""
    run = sum(1 for n in counts if n)
    return run, len(counts), 100 * run / len(counts) if counts else 0.0


def main():
    root, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    layers = sys.argv[3:]
    lines, branches = read(root, folder)
    enough = True
    print(f"{'lines':>14} {'%':>6} {'branches':>12} {'%':>6}")
    for layer in layers:
        files = sorted(
            f for f in lines
            if f.startswith(layer + "/")
            and not re.search(r"_(test|benchmark|fixture)\.", f)
        )
        run, total, percent = share([n for f in files for n in lines[f].values()])
        b_run, b_total, b_percent = share(
            [n for f in files for n in branches[f].values()]
        )
        print(
            f"{run:6} of {total:5} {percent:6.1f} {b_run:5} of {b_total:4} "
            f"{b_percent:6.1f}  {layer}"
        )
        for file in files:
            missed = [n for n, count in lines[file].items() if count == 0]
            if missed:
                print(f"{'':42}{file}: {ranges(missed)}")
        enough &= bool(files) and percent >= _WANTED_PERCENT
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
