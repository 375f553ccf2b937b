#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Writes docs/proof.md: how the project knows that its functions are right.

Every public function of math, dynamics and hqp, with the tests that reach it,
by what kind of proof they are, and what its mutants did in the last run of
//tools:mutate (docs/mutation.json).  A test reaches a function when it, or a
helper that it calls in its file or in tests/util, names it.

  bazel run //tools:proof             writes docs/proof.md
  bazel run //tools:proof -- --check  exit code 1 and the functions that no test
                                      reaches, or none of whose mutants died

What no test names is proved through the nearest tested function of its layer
that leads to it.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "mutation"))

from cpp_source import Source  # noqa: E402

_LAYERS = ("math", "dynamics", "hqp")
_KINDS = ("oracle", "property", "Ceres", "closed form")
# What tells an unlike second derivation: another library, another algorithm, or
# a test that says of two things that they are one.
_ORACLE_WORDS = {
    "mpreal", "mpfr", "KDL", "MultiBodyTree", "mjModel", "mj_forward",
    "SharedData", "Certify", "Certifier",
}
_ORACLE_NAME = re.compile(
    r"Agree|Equal|Match|Same|IsThe|AreThe|Against|Inver|Undo|SumOf|SumsOf|Column|"
    r"Differen|AsIn|AsThe|Like|Reproduce"
)
_TEST_MACROS = {
    "TEST", "TEST_F", "TEST_P", "TYPED_TEST", "RC_GTEST_PROP",
    "RC_GTEST_FIXTURE_PROP",
}


class Test:
    def __init__(self, path, suite, name, is_property, words):
        self.path = path
        self.name = f"{suite}.{name}"
        self.words = words
        if "ceres" in words:
            self.kind = "Ceres"
        elif is_property or "rc" in words and "check" in words:
            self.kind = "property"
        elif words & _ORACLE_WORDS or _ORACLE_NAME.search(name):
            self.kind = "oracle"
        else:
            self.kind = "closed form"


class Helpers:
    """What functions of a file, and of tests/util, name when they are called."""

    def __init__(self, sources):
        self._words = collections.defaultdict(set)
        self._members = collections.defaultdict(set)
        for source in sources:
            self.add(source)

    def add(self, source):
        for function in source.functions:
            if function.name in _TEST_MACROS:
                continue
            words = source.words(function)
            self._words[function.name.split("::")[-1]] |= words
            scope = function.scope or "::".join(function.name.split("::")[:-1])
            if scope:
                # To make or to use a class is to call any of it.
                self._words[scope.split("::")[-1]] |= words

    def reach(self, words):
        reached, new = set(words), set(words)
        while new:
            new = set().union(*(self._words.get(w, set()) for w in new)) - reached
            reached |= new
        return reached

    def extended(self, source):
        other = Helpers([])
        other._words = collections.defaultdict(
            set, {k: set(v) for k, v in self._words.items()}
        )
        other.add(source)
        return other


def find_tests(workspace):
    common = Helpers(
        Source(path.read_text())
        for path in sorted((workspace / "tests/util").glob("*"))
        if path.suffix in (".h", ".cc") and not path.stem.endswith("_test")
    )
    tests = []
    for folder in _LAYERS + ("tests", "robot"):
        for path in sorted((workspace / folder).rglob("*_test.cc")):
            source = Source(path.read_text())
            helpers = common.extended(source)
            for function in source.functions:
                if function.name not in _TEST_MACROS:
                    continue
                words = [
                    t.text for t in source.tokens[function.first : function.last]
                    if t.kind == "word"
                ]
                macro, suite, name = words[:3]
                tests.append(Test(
                    str(path.relative_to(workspace)), suite, name,
                    macro.startswith("RC_"), helpers.reach(set(words)),
                ))
    return tests


class Row:
    def __init__(self, path, name):
        self.path = path
        self.name = name
        self.tests = {kind: [] for kind in _KINDS}
        self.through = None  # The tested function that alone leads to it.
        self.killed = self.tried = self.mutants = 0

    @property
    def is_tested(self):
        return any(self.tests.values())

    @property
    def complaint(self):
        where = f"{self.path}: {self.name}"
        if not self.is_tested and not self.through:
            return f"{where}: no test names it, nor what leads to it"
        if self.tried and not self.killed:
            return f"{where}: none of {self.tried} mutants died"
        return None


def public_functions(workspace):
    """(header, qualified name), once for all overloads."""
    found = {}
    for layer in _LAYERS:
        for path in sorted((workspace / layer).glob("*.h")):
            source = Source(path.read_text())
            for function in source.functions:
                if function.is_public and not function.is_local and (
                    "~" not in function.name and function.name.isprintable()
                ):
                    key = (str(path.relative_to(workspace)), function.qualified)
                    found[key] = None
    return list(found)


def add_scores(workspace, rows):
    """Sums over a function's own mutants and those of what it alone can call."""
    path = workspace / "docs/mutation.json"
    results = json.loads(path.read_text()) if path.is_file() else {}
    public = {row.name for row in rows}
    by_layer = collections.defaultdict(list)
    for row in rows:
        by_layer[row.path.split("/")[0]].append(row)
    for file, functions in results.items():
        if not (workspace / file).is_file():
            continue
        source = Source((workspace / file).read_text())
        words = collections.defaultdict(set)
        for function in source.functions:
            words[function.qualified] |= source.words(function)
        private = {
            name.split("::")[-1]: name for name in words if name not in public
        }
        for row in by_layer[file.split("/")[0]]:
            if row.name not in words:
                continue
            counted, new = {row.name}, {row.name}
            while new:
                called = set().union(*(words[n] for n in new))
                new = {private[w] for w in called if w in private} - counted
                counted |= new
            for name in counted:
                result = functions.get(name, {})
                row.killed += result.get("killed", 0)
                row.tried += result.get("killed", 0) + result.get("survived", 0)
                row.mutants += result.get("mutants", 0)


def make_rows(workspace):
    tests = find_tests(workspace)
    rows = [Row(path, name) for path, name in public_functions(workspace)]
    names_in_header = collections.defaultdict(set)
    for row in rows:
        for part in row.name.split("::"):
            names_in_header[row.path].add(part)
    for row in rows:
        for test in tests:
            if row.name.split("::")[-1].startswith("operator"):
                named = bool(
                    set(row.name.split("::")[:-1]) & test.words
                    or "::" not in row.name
                    and names_in_header[row.path] & test.words
                )
            else:
                named = row.name.split("::")[-1] in test.words
            if named:
                row.tests[test.kind].append(test)
        stem = row.path.rsplit(".", 1)[0]
        for kind in _KINDS:  # A function's own tests come first.
            row.tests[kind].sort(key=lambda t: not t.path.startswith(stem))
    find_ways_through(workspace, rows)
    add_scores(workspace, rows)
    return rows


def find_ways_through(workspace, rows):
    """For what no test names: the first tested function that leads to it."""
    words = collections.defaultdict(set)  # By function: what it names.
    for layer in _LAYERS:
        for path in sorted((workspace / layer).glob("*")):
            if path.suffix in (".h", ".cc") and "_test" not in path.stem and (
                "_benchmark" not in path.stem
            ):
                source = Source(path.read_text())
                for function in source.functions:
                    words[function.qualified] |= source.words(function)
    by_word = collections.defaultdict(set)
    for name in words:
        by_word[name.split("::")[-1]].add(name)
        if "::" in name:
            by_word[name.split("::")[-2]].add(name)
    distance = {}
    for start in (row for row in rows if row.is_tested):
        if "operator" in start.name:
            continue
        layer = start.path.split("/")[0]
        reached, new, steps = {start.name}, {start.name}, 0
        while new:
            steps += 1
            named = set().union(*(words[n] for n in new))
            new = set().union(*(by_word[w] for w in named)) - reached
            reached |= new
            for row in rows:
                if row.name in new and not row.is_tested and (
                    row.path.startswith(layer + "/")
                    and steps < distance.get(id(row), 99)
                ):
                    row.through, distance[id(row)] = start.name, steps


def cell(tests):
    if not tests:
        return ""
    more = f" +{len(tests) - 1}" if len(tests) > 1 else ""
    return f"{tests[0].name}{more}"


def write(rows, head):
    lines = [head.rstrip("\n"), ""]
    counts = collections.Counter()
    for path, group in _grouped(rows):
        lines += [
            f"### {path}", "",
            "| function | oracle | property | Ceres | closed form | mutants |",
            "| --- | --- | --- | --- | --- | --- |",
        ]
        for row in group:
            counts["functions"] += 1
            counts["killed"] += row.killed
            score = f"{row.killed} of {row.tried}" if row.tried else (
                "not tried" if row.mutants else ""
            )
            cells = " | ".join(cell(row.tests[kind]) for kind in _KINDS)
            if not row.is_tested and row.through:
                cells = f"through `{row.through}` | | | "
            lines.append(f"| `{row.name}` | {cells} | {score} |")
        lines.append("")
    return "\n".join(lines)


def _grouped(rows):
    groups = collections.OrderedDict()
    for row in rows:
        groups.setdefault(row.path, []).append(row)
    return groups.items()


def main():
    parser = argparse.ArgumentParser(
        prog="proof", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    workspace = pathlib.Path(
        os.environ.get("BUILD_WORKSPACE_DIRECTORY")
        or pathlib.Path("WORKSPACE").resolve().parent
    )
    rows = make_rows(workspace)
    complaints = [row.complaint for row in rows if row.complaint]
    if arguments.check:
        for complaint in complaints:
            print(complaint)
        print(f"{len(rows)} public functions, {len(complaints)} without proof")
        return 1 if complaints or not rows else 0
    file = workspace / "docs/proof.md"
    # What people wrote stands above this line, what this program writes below.
    marker = "<!-- Below: bazel run //tools:proof -->"
    head = file.read_text().split(marker)[0] if file.is_file() else "# Proof\n\n"
    file.parent.mkdir(exist_ok=True)
    file.write_text(write(rows, head + marker) + "\n")
    for complaint in complaints:
        print(complaint)
    return 0


if __name__ == "__main__":
    sys.exit(main())
