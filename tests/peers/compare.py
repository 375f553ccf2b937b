#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares the solver, the dynamics and the controller with those of others.

Compiles an adapter for each peer with the peer's sources and Poise's, with
g++ -O3 -march=native -DNDEBUG (for dynamics also without -march), records seven sequences of the closed loop and
lets all solvers solve them in turn, each tick warm from the last one. Prints
one table, which is also written to table.md, and writes histograms of the times
of all ticks to histograms.svg. tests/peers/README.md explains the columns.

With --hqp, compares the solvers on files of the format hqp-1 and on families of
random problems instead, cold and warm. The table is also written to
problems.md. --hqp without files compares the families only.

With --dynamics, compares the dynamics with Pinocchio's instead, for our
humanoid with 50, 80 and 120 joints or for robots of URDF files, built with and
without -march=native. The table is also written to dynamics.md.

With --tick, compares whole ticks of the controller with those of TSID instead,
on states of our humanoid in closed loop. The table is also written to tick.md.

DIR holds the checkouts of the peers, as DIR/lexls, DIR/soth, DIR/pinocchio,
DIR/tsid and DIR/eiquadprog. A missing one is skipped. --out keeps programs and
ticks (500 MB); a second run reuses them.
Exit code: 0 if at least one peer was compared, 1 if dynamics differ or a tick
does not meet the dynamics, 2 for bad input.

  bazel run //tests/peers:compare -- --peers DIR
  bazel run //tests/peers:compare -- --peers DIR --hqp FILES
  bazel run //tests/peers:compare -- --peers DIR --dynamics [URDF]
  bazel run //tests/peers:compare -- --peers DIR --tick
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

import controllers  # noqa: E402
import dynamics  # noqa: E402
import figures  # noqa: E402
import histograms  # noqa: E402
import problems  # noqa: E402
from build import (  # noqa: E402
    CONTROL, DYNAMICS, SOLVER, BuildError, Builder)
from peers import (  # noqa: E402
    CONTROLLER_PEERS, DYNAMICS_PEERS, PEERS, boost_folder)

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
TREE_RECORDER = pathlib.Path("tests/peers/record_tree")
STATE_RECORDER = pathlib.Path("tests/peers/record_states")


class InputError(Exception):
    """An error of the user, as one line."""


def find_files(option, paths, here, wanted):
    """Returns absolute paths, all of which exist; or None, without paths."""
    if paths is None:
        return None
    paths = [(here / path).absolute() for path in paths]
    for path in paths:
        if not path.exists():
            raise InputError(f"{option}: {path} does not exist, want {wanted}")
    return paths


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
    parser.add_argument("--dynamics", metavar="URDF", type=pathlib.Path,
                        nargs="*", help="compare the dynamics of these robots, "
                        "or of our humanoid")
    parser.add_argument("--tick", action="store_true",
                        help="compare whole ticks of the controller")
    options = parser.parse_args(arguments)
    if os.environ.get("POISE_PARSE_ONLY"):
        sys.exit(0)
    here = pathlib.Path(os.environ.get("BUILD_WORKING_DIRECTORY") or ".")
    options.peers = (here / options.peers).absolute()
    options.out = (here / options.out).absolute()
    if not options.peers.is_dir():
        raise InputError(
            f"--peers: {options.peers} is not a folder, want one with the "
            "checkouts " + ", ".join(peer.name for peer in (
                *PEERS, *DYNAMICS_PEERS, *CONTROLLER_PEERS)))
    options.hqp = find_files("--hqp", options.hqp, here,
                             "files of the format hqp-1 or folders of them")
    if options.hqp is not None:
        options.hqp = problems.find(options.hqp)
    options.dynamics = find_files("--dynamics", options.dynamics, here,
                                  "URDF files")
    return options


def choose_peers(peers, folder, say):
    """Returns the peers that can be compared, and says which cannot."""
    chosen = []
    for peer in peers:
        missing = [each.missing(folder) for each in peer.checkouts()
                   if not each.is_in(folder)]
        if missing:
            for line in missing:
                say(line)
        elif peer.needs_boost and boost_folder(folder) is None:
            say(f"{peer.name}: needs Boost's headers, skipped; install "
                f"libboost-dev, or put them in {folder / 'boost/boost'}")
        else:
            chosen.append(peer)
    if not chosen:
        raise InputError(f"--peers: {folder} has no peer to compare with, "
                         "want at least one of those above")
    return chosen


def workspace():
    return pathlib.Path(
        os.environ.get("BUILD_WORKSPACE_DIRECTORY") or ".").absolute()


def build_programs(builder, peers, folder):
    """Returns {name: program} of the peers whose checkouts are in a folder."""
    return {
        peer.name: builder.program(peer.name, builder.jobs_of(
            peer, folder, boost_folder(folder) if peer.needs_boost else None))
        for peer in peers}


def build_solvers(options):
    """Returns {name: program}, Poise first."""
    peers = choose_peers(PEERS, options.peers, print)
    builder = Builder(workspace(), options.out, SOLVER, ["-march=native"])
    return {"Poise": builder.program("poise", adapter="poise_peer.cc"),
            **build_programs(builder, peers, options.peers)}


def output_of(command):
    result = subprocess.run([str(word) for word in command],
                            capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise InputError(f"{command[0]}: exit code {result.returncode}, want "
                         f"0: {result.stderr.strip()}")
    return result.stdout


def make_file(program, arguments, out, name):
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
    return make_file(RECORDER, sequence[1:], out, f"{sequence.force}-"
                      f"{sequence.limits}-{sequence.torque}")


def change(path, changes_bounds, out):
    """Returns the file with a problem and its changed copies."""
    arguments = [path, problems.NUM_CHANGED, changes_bounds]
    text = f"{arguments[1:]}\n{path.read_text()}"
    return make_file(HQP_TICKS, arguments, out,
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


def compare_dynamics(options, say):
    """Says the rows of the table, one robot after the other.

    Returns 0, or 1 if a result differs from the peer's.
    """
    peers = choose_peers(DYNAMICS_PEERS, options.peers, print)
    programs = {}
    for name, flags in dynamics.BUILDS:
        out = options.out / ("dynamics" + "".join(flags))
        builder = Builder(workspace(), out, DYNAMICS, flags)
        programs[name] = build_programs(builder, peers, options.peers)
    for line in dynamics.head():
        say(line)
    agrees = True
    for robot, source in dynamics.robots(options.dynamics):
        path = pathlib.Path(source)
        text = path.read_text() if options.dynamics else source
        tree = make_file(TREE_RECORDER, [source], options.out,
                          hashlib.sha256(text.encode()).hexdigest()[:20])
        for build, program in programs.items():
            results = dynamics.read(output_of([program["pinocchio"], tree]))
            say(dynamics.row(robot, build, results))
            difference = dynamics.largest_difference(results)
            agrees &= difference <= dynamics.MOST_DIFFERENCE
    if not agrees:
        say(f"A result differs by more than {dynamics.MOST_DIFFERENCE}.")
    return 0 if agrees else 1


def compare_controllers(options, say):
    """Says the rows of the table, one sequence after the other.

    Returns 0, or 1 if an answer does not meet the dynamics or none is solved.
    """
    peers = choose_peers(CONTROLLER_PEERS, options.peers, print)
    builder = Builder(workspace(), options.out / "controllers", CONTROL,
                      ["-march=native"])
    programs = build_programs(builder, peers, options.peers)
    for line in controllers.head():
        say(line)
    meets = True
    for sequence in SEQUENCES:
        if sequence.torque != 1:
            continue
        states = make_file(STATE_RECORDER, [sequence.force, sequence.limits],
                           options.out, f"{sequence.force}-{sequence.limits}")
        for program in programs.values():
            ticks = controllers.read(output_of(
                [program, states, sequence.limits, PASSES]))
            for line in controllers.rows(sequence.name, ticks,
                                         has_goal=sequence.limits):
                say(line)
            meets &= controllers.is_right(ticks)
    if not meets:
        say(f"A residual is above {controllers.MOST_RESIDUAL}, or a controller "
            "solves no tick.")
    return 0 if meets else 1


def main(arguments):
    options = parse_arguments(arguments)
    lines = []
    code = 0

    def say(line):
        lines.append(line)
        print(line, flush=True)

    try:
        if options.dynamics is not None:
            code = compare_dynamics(options, say)
            name = "dynamics.md"
        elif options.tick:
            code = compare_controllers(options, say)
            name = "tick.md"
        elif options.hqp is not None:
            compare_problems(build_solvers(options), options.hqp, options.out,
                             say)
            name = "problems.md"
        else:
            compare_sequences(build_solvers(options), options.out, say)
            name = "table.md"
    except BuildError as error:
        raise InputError(f"compiling: {error}") from error
    (options.out / name).write_text("\n".join(lines) + "\n")
    return code


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except InputError as error:
        print(f"compare: {error}", file=sys.stderr)
        sys.exit(2)
