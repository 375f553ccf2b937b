# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Dynamics beside those of a peer: robots, results and the table."""

import collections
import math

# The number of fingers that record_tree adds on each hand of our humanoid.
OUR_ROBOTS = (("humanoid, 50 joints", "0"), ("humanoid, 80 joints", "3"),
              ("humanoid, 120 joints", "7"))

FUNCTIONS = ("bias", "RNEA", "CRBA", "CMM", "ABA", "whole tick",
             "derivatives of RNEA")

# Flags of the two builds, beside those of all programs.
BUILDS = (("-march=native", ("-march=native",)), ("no -march", ()))

# ABA loses up to the condition of M, about 1e4, of 16 digits; a wrong sign or
# frame changes the first digits.
MOST_DIFFERENCE = 1e-10

Result = collections.namedtuple("Result", "ours theirs difference")


def robots(files):
    """Returns pairs of a name and the argument of record_tree."""
    if not files:
        return list(OUR_ROBOTS)
    return [(path.stem, str(path)) for path in files]


def read(text):
    """Returns {function: result} of the output of a peer's program."""
    results = {}
    for line in text.splitlines():
        name, *numbers = line.rsplit(maxsplit=3)
        results[name] = Result(*map(float, numbers))
    return results


def largest_difference(results):
    """Returns the largest one of those that were compared; NaN counts most."""
    differences = [result.difference for result in results.values()
                   if not result.difference < 0]
    return max(differences, key=lambda each: (math.isnan(each), each))


def head():
    cells = ["robot", "build", *FUNCTIONS, "largest difference"]
    return ["| " + " | ".join(cells) + " |", "|" + " --- |" * len(cells)]


def row(robot, build, results):
    """Returns a row: times of Poise and of the peer, and their ratio."""
    cells = [robot, build]
    for function in FUNCTIONS:
        ours, theirs, _ = results[function]
        cells.append(f"{ours:.2f} / {theirs:.2f} = {ours / theirs:.2f}")
    largest = largest_difference(results)
    return "| " + " | ".join([*cells, f"{largest:.0e}"]) + " |"
