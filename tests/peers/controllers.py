# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Whole ticks of controllers: results of a peer's program and the table."""

import collections
import math

import figures

# The feet settle in these first ticks. The recorded ticks of the solvers also
# begin after them.
NOT_COUNTED = 50

# The goal: Poise's time divided by that of the peer, at the median and worst.
MOST_AT_MEDIAN = 0.25
MOST_AT_WORST = 1

# Both controllers solve the dynamics to 1e-11 or better; a wrong sign or frame
# changes the first digits.
MOST_RESIDUAL = 1e-9

Tick = collections.namedtuple("Tick", "time is_solved residual")
Figures = collections.namedtuple(
    "Figures", "median p99 worst not_solved residual")


def read(text):
    """Returns {controller: counted ticks} of a program's output."""
    ticks = collections.defaultdict(list)
    for line in text.splitlines():
        name, time, is_solved, residual = line.split()
        ticks[name].append(Tick(float(time), is_solved == "1",
                                float(residual)))
    return {name: each[NOT_COUNTED:] for name, each in ticks.items()}


def _largest(residuals):
    """Returns the largest residual, or 0 without any; NaN counts most."""
    return max(residuals, key=lambda each: (math.isnan(each), each), default=0)


def largest_residual(ticks):
    """Returns the largest residual of all answers that are reported solved."""
    return _largest([tick.residual for each in ticks.values() for tick in each
                     if tick.is_solved])


def summarize(ticks):
    times = [tick.time for tick in ticks]
    return Figures(
        figures.quantile(times, 0.5), figures.quantile(times, 0.99),
        max(times), sum(not tick.is_solved for tick in ticks),
        _largest([tick.residual for tick in ticks if tick.is_solved]))


def is_right(ticks):
    """Returns whether each controller solves ticks, and all of these rightly."""
    return (largest_residual(ticks) <= MOST_RESIDUAL
            and all(any(tick.is_solved for tick in each)
                    for each in ticks.values()))


def head():
    cells = ["sequence", "controller", "median", "p99", "worst", "not solved",
             "residual", "Poise / peer: median", "p99", "worst", "goal"]
    return ["| " + " | ".join(cells) + " |", "|" + " --- |" * len(cells)]


def goal(ours, theirs):
    """Returns whether Poise has reached its goal.

    It must solve all ticks, and the peer's slow failures allow it no more time.
    """
    return (ours.not_solved == 0 and theirs.not_solved == 0
            and ours.residual <= MOST_RESIDUAL
            and ours.median <= MOST_AT_MEDIAN * theirs.median
            and ours.worst <= MOST_AT_WORST * theirs.worst)


def rows(sequence, ticks, has_goal):
    """Returns the row of Poise, then those of its peers.

    The goal is set only for sequences with limits.
    """
    results = {name: summarize(each) for name, each in ticks.items()}
    ours = results["Poise"]
    lines = []
    for name, theirs in results.items():
        cells = [sequence, name]
        cells += [f"{time:.1f}" for time in theirs[:3]]
        cells += [str(theirs.not_solved), f"{theirs.residual:.0e}"]
        if theirs is ours:
            cells += [""] * 4
        else:
            cells += [f"{our / their:.3f}"
                      for our, their in zip(ours[:3], theirs[:3])]
            reached = "yes" if goal(ours, theirs) else "no"
            cells += [reached if has_goal else ""]
        lines.append("| " + " | ".join(cells) + " |")
    return lines
