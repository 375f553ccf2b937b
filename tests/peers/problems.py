# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compares the solvers on problems of the format hqp-1, cold and warm."""

import collections

import families
import figures

# `files` are the problems of a row of the table. With `changes_bounds`, the
# problems of the warm solves differ in their bounds too, not only in b.
Problem = collections.namedtuple("Problem", "name files changes_bounds")

# Result of a solver for the cold or for the warm solves of a problem: the median
# time, whether all are right, and whether a level costs less than Poise's.
Result = collections.namedtuple("Result", "time is_right is_lower")

# Changed copies of each problem, which are solved warm.
NUM_CHANGED = 8

# CPU time of a program for one file, and how often each program runs.
SECONDS = 0.2
ROUNDS = 3

# Poise has reached its goal if its time is at most this part of the time of
# the fastest peer that is right.
GOAL = 1.05
GOAL_OF_TOYS = 1.2
MOST_VARIABLES_OF_TOYS = 2


def find(paths):
    """Returns the files that are named or are in a folder that is named."""
    files = []
    for path in paths:
        files += sorted(path.glob("*.json")) if path.is_dir() else [path]
    return files


def all_problems(files, out):
    """Returns a problem for each file and each family."""
    problems = [Problem(path.stem, [path], 0) for path in files]
    folder = out / "families"
    folder.mkdir(parents=True, exist_ok=True)
    for number, family in enumerate(families.FAMILIES):
        drawn = [folder / f"{number}-{seed}.json" for seed in families.SEEDS]
        for seed, path in zip(families.SEEDS, drawn):
            families.write(family, seed, path)
        problems.append(Problem(family.name, drawn, 1))
    return problems


def judge(files, reference):
    """Returns the results of a solver, (cold, warm).

    `files` are its ticks, by file, and `reference` those of Poise. The first
    tick of a file is cold, the others are warm. A tick that Poise does not
    certify has no reference.
    """
    def result(part):
        pairs = [pair for ticks, ours in zip(files, reference)
                 for pair in zip(ticks[part], ours[part])]
        signs = [figures.first_difference(tick.costs, ours.costs, ours.floors)
                 for tick, ours in pairs if ours.is_solved]
        return Result(
            figures.quantile([tick.time for tick, _ in pairs], 0.5),
            all(tick.is_solved for tick, _ in pairs) and 1 not in signs,
            -1 in signs)

    return result(slice(0, 1)), result(slice(1, None))


def goal(ours, peers, variables):
    """Returns "yes" if Poise is right and as fast as the goal, else "no"."""
    part = GOAL_OF_TOYS if variables <= MOST_VARIABLES_OF_TOYS else GOAL
    times = [peer.time for peer in peers if peer.is_right]
    return "yes" if ours.is_right and (
        not times or ours.time <= part * min(times)) else "no"


def ratio(ours, peer):
    """Returns the cell that compares Poise with a peer."""
    if not peer.is_right:
        return "-"
    return f"{ours.time / peer.time:.2f}" + (" lower" if peer.is_lower else "")


def head(names):
    cells = ["problem", "Poise: cold, warm [us]"]
    cells += [f"Poise / {name}: cold, warm" for name in names]
    cells.append("goal: cold, warm")
    return ["| " + " | ".join(cells) + " |", "|" + " --- |" * len(cells)]


def row(name, ours, peers, variables):
    """Returns a row of the table; each result is a pair (cold, warm)."""
    cells = [name, ", ".join(f"{result.time:.1f}" + (
        "" if result.is_right else " not solved") for result in ours)]
    cells += [", ".join(map(ratio, ours, peer)) for peer in peers]
    cells.append(", ".join(goal(mine, each, variables)
                           for mine, *each in zip(ours, *peers)))
    return "| " + " | ".join(cells) + " |"
