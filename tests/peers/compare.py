#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares the solver with those of others on the same problems.

Compiles an adapter for each peer with the peer's sources and Poise's, with
g++ -O3 -march=native -DNDEBUG, records seven sequences of the closed loop and
lets all solvers solve them in turn, each tick warm from the last one. Prints
one table, which is also written to table.md, and writes histograms of the times
of all ticks to histograms.svg. tests/peers/README.md explains the columns.

With --hqp, compares the solvers on files of the format hqp-1 and on families of
random problems instead, cold and warm. The table is also written to
problems.md. --hqp without files compares the families only.

DIR holds the checkouts of the peers, as DIR/lexls and DIR/soth. A missing one
is skipped. --out keeps programs and ticks (300 MB); a second run reuses them.
Exit code: 0 if at least one peer was compared, 2 for bad input.

  bazel run //tests/peers:compare -- --peers DIR
  bazel run //tests/peers:compare -- --peers DIR --hqp FILES
"""

import argparse
import collections
import hashlib
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import figures  # noqa: E402
import histograms  # noqa: E402
import problems  # noqa: E402
from build import BuildError, Builder  # noqa: E402
from peers import PEERS, boost_folder  # noqa: E402

Sequence = collections.namedtuple("Sequence", "name force limits torque")

SEQUENCES = (
    Sequence("standing", 0, 0, 1),
    Sequence("standing, limits", 0, 1, 1),
    Sequence("120 N", 120, 0, 1),
    Sequence("120 N, limits", 120, 1, 1),
    Sequence("300 N", 300, 0, 1),
    Sequence("300 N, limits", 300, 1, 1),
    Sequence("5 % torque", 0, 1, 0.05),
)

# The solvers take turns, pass by pass, so that a load of the machine slows all
# of them.
PASSES = 5

# Where Bazel puts these programs, in the working directory of `bazel run`.
RECORDER = pathlib.Path("tests/peers/record_ticks")
HQP_TICKS = pathlib.Path("tests/peers/hqp_ticks")


class InputError(Exception):
    """An error of the user, as one line."""


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="compare", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peers", metavar="DIR", type=pathlib.Path,
                        required=True, help="the folder with the checkouts")
    parser.add_argument("--out", metavar="DIR", type=pathlib.Path,
                        default=pathlib.Path("peers-out"),
                        help="programs, ticks and table (default: peers-out)")
    parser.add_argument("--hqp", metavar="FILE_OR_FOLDER", type=pathlib.Path,
                        nargs="*", help="compare problems of the format hqp-1 "
                        "and random families, not the recorded ticks")
    options = parser.parse_args(arguments)
    if os.environ.get("POISE_PARSE_ONLY"):
        sys.exit(0)
    here = pathlib.Path(os.environ.get("BUILD_WORKING_DIRECTORY") or ".")
    options.peers = (here / options.peers).absolute()
    options.out = (here / options.out).absolute()
    if not options.peers.is_dir():
        raise InputError(
            f"--peers: {options.peers} is not a folder, want one with the "
            "checkouts " + ", ".join(peer.name for peer in PEERS))
    if options.hqp is not None:
        options.hqp = problems.find([(here / path).absolute()
                                     for path in options.hqp])
        for path in options.hqp:
            if not path.is_file():
                raise InputError(f"--hqp: {path} does not exist, want files "
                                 "of the format hqp-1 or folders of them")
    return options


def choose_peers(folder, say):
    """Returns the peers that can be compared, and says which cannot."""
    chosen = []
    for peer in PEERS:
        if not peer.is_in(folder):
            say(peer.missing(folder))
        elif peer.needs_boost and boost_folder(folder) is None:
            say(f"{peer.name}: needs Boost's headers, skipped; install "
                f"libboost-dev, or put them in {folder / 'boost/boost'}")
        else:
            chosen.append(peer)
    if not chosen:
        raise InputError(f"--peers: {folder} has no peer to compare with, "
                         "want at least one of those above")
    return chosen


def build_programs(peers, options):
    """Returns {name: program}, Poise first."""
    root = pathlib.Path(os.environ.get("BUILD_WORKSPACE_DIRECTORY") or ".")
    builder = Builder(root.absolute(), options.out)
    programs = {"Poise": builder.program("poise", "poise_peer.cc")}
    for peer in peers:
        boost = boost_folder(options.peers) if peer.needs_boost else None
        programs[peer.name] = builder.program(
            peer.name, peer.adapter, peer, options.peers / peer.name, boost)
    return programs


def output_of(command):
    result = subprocess.run([str(word) for word in command],
                            capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise InputError(f"{command[0]}: exit code {result.returncode}, want "
                         f"0: {result.stderr.strip()}")
    return result.stdout


def make_ticks(program, arguments, out, name):
    """Returns the file that a program writes, made unless it exists."""
    if not program.is_file():
        raise InputError(f"{program.absolute()} does not exist; start this "
                         "program by `bazel run //tests/peers:compare`")
    digest = hashlib.sha256(program.read_bytes()).hexdigest()[:12]
    path = out / "ticks" / digest / name
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(".part")
        output_of([program.absolute(), *arguments, part])
        part.rename(path)
    return path


def record(sequence, out):
    """Returns the file with the ticks of a sequence."""
    return make_ticks(RECORDER, sequence[1:], out, f"{sequence.force}-"
                      f"{sequence.limits}-{sequence.torque}")


def change(path, changes_bounds, out):
    """Returns the file with a problem and its changed copies."""
    arguments = [path, problems.NUM_CHANGED, changes_bounds]
    text = f"{arguments[1:]}\n{path.read_text()}"
    return make_ticks(HQP_TICKS, arguments, out,
                      hashlib.sha256(text.encode()).hexdigest()[:20])


def measure(programs, path, passes, *arguments):
    """Returns {name: ticks}, each tick with the time of its fastest pass."""
    results = {name: [] for name in programs}
    for _ in range(passes):
        for name, program in programs.items():
            results[name].append(figures.read_ticks(
                output_of([program, path, *arguments])))
    return {name: figures.fastest(each) for name, each in results.items()}


def compare_sequences(programs, out, say):
    """Says the rows of the table, one sequence after the other."""
    for line in figures.head():
        say(line)
    times = {}
    for sequence in SEQUENCES:
        ticks = measure(programs, record(sequence, out), PASSES)
        times[sequence.name] = {name: [tick.time for tick in solved]
                                for name, solved in ticks.items()}
        reference = ticks.pop("Poise")
        ours = figures.summarize(reference, reference)
        say(figures.row(sequence.name, "Poise", ours))
        for name, solved in ticks.items():
            say(figures.row(sequence.name, name,
                            figures.summarize(solved, reference), ours))
    (out / "histograms.svg").write_text(histograms.draw(times))


def compare_problems(programs, files, out, say):
    """Says the rows of the table, one problem or family after the other."""
    for line in problems.head(list(programs)[1:]):
        say(line)
    for problem in problems.all_problems(files, out):
        measured = [
            measure(programs, change(path, problem.changes_bounds, out),
                    problems.ROUNDS, problems.SECONDS)
            for path in problem.files]
        variables = json.loads(problem.files[0].read_text())["variables"]
        ours = [solved["Poise"] for solved in measured]
        results = [problems.judge([solved[name] for solved in measured], ours)
                   for name in programs]
        say(problems.row(problem.name, results[0], results[1:], variables))


def main(arguments):
    options = parse_arguments(arguments)
    lines = []

    def say(line):
        lines.append(line)
        print(line, flush=True)

    try:
        peers = choose_peers(options.peers, lambda line: print(line))
        programs = build_programs(peers, options)
    except BuildError as error:
        raise InputError(f"compiling: {error}") from error
    if options.hqp is None:
        compare_sequences(programs, options.out, say)
        name = "table.md"
    else:
        compare_problems(programs, options.hqp, options.out, say)
        name = "problems.md"
    (options.out / name).write_text("\n".join(lines) + "\n")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except InputError as error:
        print(f"compare: {error}", file=sys.stderr)
        sys.exit(2)
