#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Mutation testing: do the tests fail if the code has an error?

Makes mutants of math, dynamics and hqp, one at a time: a flipped sign, another
operator, index, comparison or constant, a missing term.  Each mutant is built
and tested in a copy of the tree: first with the file's own tests, then with
those of its layer, then with all that depend on it.  A mutant survives if no
test fails, which shows that a test is missing.  A mutant that does not compile,
or compiles to the same object code, does not count.  Figures say how many mutants were
killed of those tried of those possible.

The ledger, tools/quality/mutation/ledger.tsv, names each mutant by its function
and a digest of its expression.  It lists survivors with reasons, and equivalent
mutants, which are never tried.

After an interruption the same command continues.  Exit code: 0 if the share
of killed among tried mutants reaches --threshold, 1 if not, 2 for bad input.
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
import report
import workshop
from ledger import Ledger
from workshop import INVALID, KILLED, SAME, SURVIVED

_GLOBS = ["math/*", "dynamics/*", "hqp/*"]
_LEDGER = "tools/quality/mutation/ledger.tsv"
_MOST_STALE = 2  # Percentage of the ledger's entries.


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="mutate", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--files", nargs="+", metavar="GLOB", default=_GLOBS,
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
        help="the share of killed among tried mutants below which the exit code "
        "is 1 (default: 95)",
    )
    parser.add_argument("--list", action="store_true", help="list, and stop")
    parser.add_argument(
        "--ledger", action="store_true",
        help="print what the ledger says, with source lines, and stop",
    )
    parser.add_argument(
        "--stale", action="store_true",
        help="print entries of the ledger whose code is gone, and stop; exit code "
        f"1 if these are more than {_MOST_STALE} %% of all",
    )
    parser.add_argument(
        "--record", action="store_true", help=f"write the results into {_LEDGER}"
    )
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
    options = parser.parse_args()
    # A test of the documentation asks only whether a command line parses.
    if os.environ.get("POISE_PARSE_ONLY"):
        sys.exit(0)
    return options


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
    """Returns a sample that is constant for constant expressions."""
    def rank(mutant):
        name = f"{seed} {mutant.place} {mutant.digest}"
        return hashlib.sha256(name.encode()).digest()

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
    """Returns a digest of the tests of a file; if it changes, survivors are retried."""
    digest = hashlib.sha256()
    for package in sorted({t.split(":")[0][2:] for t in tests} | {"tests/util"}):
        for path in sorted((workspace / package).glob("*")):
            if path.name.endswith("_test.cc") or package.startswith("tests"):
                if path.is_file():
                    digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


class State:
    """Results by mutant id, in a file that only grows."""

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


def try_all(chosen, shop, state, reach, quiet):
    """Tries mutants without a result; returns the results by mutant."""
    results, counts = {}, collections.Counter()
    progress = Progress(len(chosen))
    limits, broken = {}, set()
    for mutant in chosen:
        path = mutant.path
        if path in broken:
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


def read_pool(workspace, globs):
    """Returns every mutant of the sources, except of programs."""
    pool = []
    for path in find_sources(workspace, globs):
        text = (workspace / path).read_text()
        if "\nint main(" not in text:
            pool += mutants.make_mutants(path, text)
    return pool


def check_ledger(ledger, pool):
    """Prints stale entries; returns exit code 1 if there are too many."""
    lines = ledger.stale(pool)
    for line in lines:
        print("stale: " + line)
    share = 100 * len(lines) / max(1, len(ledger))
    print(
        f"{len(lines)} of {len(ledger)} entries of {_LEDGER} are stale, "
        f"{share:.1f} %; at most {_MOST_STALE} % may be"
    )
    return 0 if share <= _MOST_STALE else 1


def open_folder(arguments):
    """Opens the folder with copy, build and state, and locks it."""
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
        fail(f"{folder}: another run uses this folder; give --work DIR")
    return folder, lock


def try_chosen(arguments, workspace, chosen):
    """Returns (results by mutant, state, omitted files), or None if interrupted."""
    folder, lock = open_folder(arguments)
    with lock:
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        shop = workshop.Workshop(workspace, folder, arguments.bazel_flag)
        state = State(folder / "results.jsonl")
        shop.copy()
        try:
            results, broken = try_all(
                chosen, shop, state, arguments.reach, arguments.json
            )
        except KeyboardInterrupt:
            print("\nmutate: interrupted; the same command goes on", file=sys.stderr)
            return None
        except workshop.BazelError as error:
            fail(str(error))
        finally:
            shop.close()
    return results, state, broken


def keep(arguments, workspace, pool, ledger, state):
    """Writes the files of --out and --record."""
    def verdict_of(mutant):
        entry = state.known.get(mutant.id)
        return entry and entry["verdict"]

    if arguments.out:
        out = pathlib.Path(
            os.environ.get("BUILD_WORKING_DIRECTORY") or os.getcwd(), arguments.out
        )
        summary = report.summarize(pool, verdict_of, ledger)
        out.write_text(json.dumps(summary, indent=1) + "\n")
    if arguments.record:
        ledger.record(pool, verdict_of)
        ledger.write(workspace / _LEDGER)


def conclude(arguments, selected, ledger, results, broken):
    """Prints the figures; returns the exit code."""
    counts = collections.Counter(e["verdict"] for e in results.values())
    possible = sum(1 for m in selected if not ledger.is_equivalent(m)) - (
        counts[INVALID] + counts[SAME]
    )
    tried = counts[KILLED] + counts[SURVIVED]
    if arguments.json:
        print(json.dumps({
            "killed": counts[KILLED], "tried": tried, "possible": possible,
            "survived": counts[SURVIVED], "invalid": counts[INVALID],
            "same_code": counts[SAME],
            "equivalent": sum(1 for m in selected if ledger.is_equivalent(m)),
            "left_out": sorted(broken),
            "survivors": [
                e for e in results.values() if e["verdict"] == SURVIVED
            ],
        }, indent=1))
    else:
        report.show_results(selected, results, ledger)
        print(
            f"{counts[KILLED]} killed of {tried} tried of {possible} possible; "
            f"{counts[INVALID]} did not compile, {counts[SAME]} are the same code"
        )
    enough = tried and 100 * counts[KILLED] >= arguments.threshold * tried
    return 0 if enough and not broken else 1


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
    pool = read_pool(workspace, arguments.files)
    if not pool:
        fail(f"no source matches {' '.join(arguments.files)}")
    try:
        ledger = Ledger.read(workspace / _LEDGER)
    except (OSError, ValueError) as error:
        fail(str(error))
    if arguments.stale:
        return check_ledger(ledger, read_pool(workspace, _GLOBS))
    selected = [
        m for m in pool
        if any(fnmatch.fnmatch(m.function, g) for g in arguments.functions)
    ]
    if arguments.ledger:
        report.show_ledger(selected, ledger)
        return 0
    chosen = choose(
        [m for m in selected if not ledger.is_equivalent(m)],
        arguments.sample, arguments.per_function, arguments.seed,
    )
    if arguments.list:
        for mutant in chosen:
            print(mutant.describe())
        print(f"{len(chosen)} mutants of {len(pool)}")
        return 0
    tried = try_chosen(arguments, workspace, chosen)
    if tried is None:
        return 1
    results, state, broken = tried
    code = conclude(arguments, selected, ledger, results, broken)
    keep(arguments, workspace, pool, ledger, state)
    return code


if __name__ == "__main__":
    sys.exit(main())
