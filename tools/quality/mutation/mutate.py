#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Mutation testing: would the tests notice a wrong sign?

Makes small slips in math, dynamics and hqp, one at a time: a flipped sign, an
operator, an index, a comparison, a constant, a missing term.  Each is built
and tested in a copy of the tree, on the file's own tests first, then on its
layer's, then on all that depend on it.  A slip that no test notices survived,
and shows where a test is missing.  A mutant that does not compile, or compiles
to the same object code, counts neither way.

Interrupted, the same command goes on where it was.  Exit code: 0 if the score
reaches --threshold, 1 if not, 2 for bad input.
"""

import argparse
import collections
import fcntl
import fnmatch
import hashlib
import json
import math
import os
import pathlib
import signal
import sys
import time

import mutants
import survivors
import workshop
from cpp_source import Source
from workshop import INVALID, KILLED, SAME, SURVIVED

_LAYERS = ("math", "dynamics", "hqp")


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="mutate", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--files", nargs="+", metavar="GLOB", default=[f"{l}/*" for l in _LAYERS],
        help="sources to mutate, from the workspace's root (default: all of "
        "math, dynamics and hqp)",
    )
    parser.add_argument(
        "--functions", nargs="+", metavar="GLOB", default=["*"],
        help="functions to mutate, as Class::Name (default: all)",
    )
    parser.add_argument("--sample", type=int, metavar="N", help="try N mutants")
    parser.add_argument(
        "--per-function", type=int, metavar="N",
        help="stratified: try N mutants of every function, all where it has fewer",
    )
    parser.add_argument(
        "--seed", type=int, default=1, metavar="N", help="draw another sample"
    )
    parser.add_argument(
        "--reach", choices=("file", "layer", "all"), default="all",
        help="how far to look for a test that notices (default: all)",
    )
    parser.add_argument(
        "--threshold", type=float, default=95, metavar="PERCENT",
        help="the score below which the exit code is 1 (default: 95)",
    )
    parser.add_argument("--list", action="store_true", help="list, and stop")
    parser.add_argument("--json", action="store_true", help="print JSON only")
    parser.add_argument(
        "--out", metavar="FILE", help="write the summary of all known results"
    )
    parser.add_argument(
        "--work", metavar="DIR", help="copy, build and state (default: "
        "~/.cache/poise/mutate)",
    )
    parser.add_argument(
        "--bazel-flag", action="append", default=[], metavar="FLAG",
        help="passed on to bazel test; may be repeated",
    )
    return parser.parse_args()


def fail(message):
    print(f"mutate: {message}", file=sys.stderr)
    sys.exit(2)


def find_sources(workspace, globs):
    found = set()
    for path in workspace.rglob("*"):
        relative = str(path.relative_to(workspace))
        if path.suffix in (".h", ".cc") and path.is_file() and not any(
            path.stem.endswith(end) for end in ("_test", "_benchmark")
        ) and any(fnmatch.fnmatch(relative, g) for g in globs):
            found.add(relative)
    return sorted(p for p in found if not p.startswith("bazel-"))


def choose(pool, sample, per_function, seed):
    """A sample that stays the same where the code does."""
    def rank(mutant):
        return hashlib.sha256(f"{seed} {mutant.id}".encode()).digest()

    pool = sorted(pool, key=rank)
    if per_function is not None:
        counts = collections.Counter()
        chosen = []
        for mutant in pool:
            counts[mutant.path, mutant.function] += 1
            if counts[mutant.path, mutant.function] <= per_function:
                chosen.append(mutant)
        pool = chosen
    if sample is not None:
        pool = pool[:sample]
    return sorted(pool, key=lambda m: (m.path, m.start, m.end, m.new))


def tests_digest(workspace, tests):
    """Changes when the tests of a file may have: then survivors get another go."""
    digest = hashlib.sha256()
    for package in sorted({t.split(":")[0][2:] for t in tests} | {"tests/util"}):
        for path in sorted((workspace / package).glob("*")):
            if path.name.endswith("_test.cc") or package.startswith("tests"):
                if path.is_file():
                    digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


class State:
    """What is known of each mutant, by its id, in a file that grows."""

    def __init__(self, path):
        self._path = path
        self.known = {}
        if path.is_file():
            for line in path.read_text().splitlines():
                try:
                    entry = json.loads(line)
                    self.known[entry["id"]] = entry
                except (ValueError, KeyError):
                    pass  # The last line of a run that was cut off.

    def add(self, entry):
        self.known[entry["id"]] = entry
        with open(self._path, "a") as file:
            file.write(json.dumps(entry) + "\n")


class Progress:
    def __init__(self, total):
        self._total = total
        self._start = time.monotonic()
        self._done = 0
        self._terminal = sys.stderr.isatty()

    def show(self, counts, last):
        self._done += 1
        each = (time.monotonic() - self._start) / self._done
        left = math.ceil(each * (self._total - self._done) / 60)
        line = (
            f"[{self._done}/{self._total}] {counts[KILLED]} killed, "
            f"{counts[SURVIVED]} survived, {counts[INVALID] + counts[SAME]} do not "
            f"count; {each:.1f} s each, {left} min left"
        )
        if self._terminal:
            print(f"\r\033[K{line}", end="", file=sys.stderr, flush=True)
        elif last == SURVIVED or self._done % 10 == 0 or self._done == self._total:
            print(line, file=sys.stderr, flush=True)

    def clear(self):
        if self._terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def try_all(chosen, shop, state, reach, explained, quiet):
    """Tries what is not known; the results by mutant."""
    results, counts = {}, collections.Counter()
    progress = Progress(len(chosen))
    limits, broken = {}, set()
    for mutant in chosen:
        path = mutant.path
        if mutant in explained or path in broken:
            continue
        stages = shop.stages(path, reach)
        tests = [t for stage in stages for t in stage]
        digest = tests_digest(shop.tree, tests)
        entry = state.known.get(mutant.id)
        if entry is None or entry["verdict"] == SURVIVED and entry["tests"] != digest:
            if path not in limits:
                try:
                    slowest = shop.baseline(path, reach)
                except workshop.BazelError as error:
                    progress.clear()
                    print(f"mutate: {error}; left out", file=sys.stderr)
                    broken.add(path)
                    continue
                limits[path] = int(20 + 5 * slowest)
            text = (shop.tree / path).read_text()
            verdict, by, seconds = shop.attempt(
                path, mutants.apply(mutant, text), reach, limits[path]
            ) if tests else (SURVIVED, "", 0.0)
            entry = {
                "id": mutant.id, "verdict": verdict, "by": by, "path": path,
                "function": mutant.function, "line": mutant.line,
                "kind": mutant.kind, "before": mutant.before,
                "after": mutant.after, "tests": digest,
                "seconds": round(seconds, 1),
            }
            state.add(entry)
        if entry["verdict"] == SURVIVED and not quiet:
            progress.clear()
            print("survived: " + mutant.describe(), flush=True)
        results[mutant] = entry
        counts[entry["verdict"]] += 1
        progress.show(counts, entry["verdict"])
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return results, broken


def percent(killed, survived):
    return 100 * killed / (killed + survived) if killed + survived else None


def summarize(workspace, pool, state, explained):
    """All that is known of the sources as they are, by file and function."""
    files = {}
    digests = {
        path: Source((workspace / path).read_text()).digests()
        for path in {mutant.path for mutant in pool}
    }
    for mutant in pool:
        entry = state.known.get(mutant.id)
        file = files.setdefault(mutant.path, {})
        row = file.setdefault(
            mutant.function or "(constants)",
            {"mutants": 0, "killed": 0, "survived": 0, "equivalent": 0, "invalid": 0},
        )
        if mutant.function:
            row["digest"] = digests[mutant.path][mutant.function]
        row["mutants"] += 1
        if mutant in explained or entry and entry["verdict"] == SAME:
            row["equivalent"] += 1
        elif entry and entry["verdict"] == INVALID:
            row["invalid"] += 1
        elif entry and entry["verdict"] == KILLED:
            row["killed"] += 1
        elif entry and entry["verdict"] == SURVIVED:
            row["survived"] += 1
            row.setdefault("survivors", []).append(
                {"before": mutant.before, "after": mutant.after}
            )
    return {
        path: tried for path, rows in files.items() if (tried := {
            name: row for name, row in rows.items()
            if any(n for k, n in row.items() if k not in ("mutants", "digest"))
        })
    }


def show(results):
    """The score by file and function."""
    table = collections.defaultdict(collections.Counter)
    for mutant, entry in results.items():
        for function in ("", "  " + (mutant.function or "(constants)")):
            table[mutant.path, function][entry["verdict"]] += 1
    print(f"{'killed':>8} {'survived':>8} {'score':>7}")
    for (path, function), counts in sorted(table.items()):
        score = percent(counts[KILLED], counts[SURVIVED])
        print(
            f"{counts[KILLED]:8} {counts[SURVIVED]:8} "
            f"{'-' if score is None else f'{score:.0f} %':>7}  {function or path}"
        )


def main():
    arguments = parse_arguments()
    workspace = pathlib.Path(
        os.environ.get("BUILD_WORKSPACE_DIRECTORY") or os.getcwd()
    )
    if not (workspace / "WORKSPACE").is_file():
        fail(f"{workspace}: no WORKSPACE here; use bazel run //tools:mutate")
    for name in ("sample", "per_function"):
        value = getattr(arguments, name)
        if value is not None and value < 1:
            fail(f"--{name.replace('_', '-')} is {value}, must be positive")
    paths = find_sources(workspace, arguments.files)
    if not paths:
        fail(f"no source matches {' '.join(arguments.files)}")
    pool = []
    for path in paths:
        text = (workspace / path).read_text()
        if "\nint main(" not in text:  # A program is not what tests call.
            pool += mutants.make_mutants(path, text)
    try:
        explained = survivors.explained(
            workspace / "tools/quality/mutation/equivalent.txt", pool
        )
    except ValueError as error:
        fail(str(error))
    chosen = choose(
        [
            m for m in pool if m not in explained
            and any(fnmatch.fnmatch(m.function, g) for g in arguments.functions)
        ],
        arguments.sample, arguments.per_function, arguments.seed,
    )
    if arguments.list:
        for mutant in chosen:
            print(mutant.describe())
        print(f"{len(chosen)} mutants of {len(pool)}")
        return 0

    folder = pathlib.Path(
        arguments.work or pathlib.Path.home() / ".cache/poise/mutate"
    )
    if arguments.work and not folder.is_absolute():
        folder = pathlib.Path(
            os.environ.get("BUILD_WORKING_DIRECTORY") or os.getcwd()
        ) / folder
    folder.mkdir(parents=True, exist_ok=True)
    lock = open(folder / "lock", "w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        fail(f"{folder}: another run is at work there; give --work DIR")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    shop = workshop.Workshop(workspace, folder, arguments.bazel_flag)
    state = State(folder / "results.jsonl")
    shop.copy()
    try:
        results, broken = try_all(chosen, shop, state, arguments.reach, explained, arguments.json)
    except KeyboardInterrupt:
        print("\nmutate: interrupted; the same command goes on", file=sys.stderr)
        return 1
    except workshop.BazelError as error:
        fail(str(error))
    finally:
        shop.close()

    if arguments.out:
        out = pathlib.Path(
            os.environ.get("BUILD_WORKING_DIRECTORY") or os.getcwd(), arguments.out
        )
        out.write_text(
            json.dumps(summarize(workspace, pool, state, explained), indent=1) + "\n"
        )
    counts = collections.Counter(e["verdict"] for e in results.values())
    score = percent(counts[KILLED], counts[SURVIVED])
    if arguments.json:
        print(json.dumps({
            "tried": len(results), "killed": counts[KILLED],
            "survived": counts[SURVIVED], "invalid": counts[INVALID],
            "same_code": counts[SAME], "explained": len(explained),
            "score_percent": score, "left_out": sorted(broken),
            "survivors": [
                e for e in results.values() if e["verdict"] == SURVIVED
            ],
        }, indent=1))
    else:
        show(results)
        print(
            f"{counts[KILLED]} killed, {counts[SURVIVED]} survived, "
            f"{counts[INVALID]} did not compile, {counts[SAME]} are the same code, "
            f"{len(explained)} explained in tools/quality/mutation/equivalent.txt: score "
            + ("-" if score is None else f"{score:.1f} %")
        )
    return 0 if score is not None and score >= arguments.threshold and (
        not broken
    ) else 1


if __name__ == "__main__":
    sys.exit(main())
