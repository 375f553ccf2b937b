# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The figures of the comparison, and its table."""

import collections
import math

# A level counts as wrong if its cost differs by more than this part of it.
TOLERANCE = 1e-3

Tick = collections.namedtuple("Tick", "time is_solved costs floors")

Figures = collections.namedtuple(
    "Figures", "median p99 worst p999 unsolved wrong lower")

HEAD = ("sequence", "solver", "median [us]", "p99 [us]", "worst [us]",
        "p99.9 / median", "worst / median", "not solved [%]", "wrong [%]", "lower [%]",
        "Poise / peer: median", "p99", "worst")


def read_ticks(text):
    """Returns the ticks of the output of measure."""
    ticks = []
    for line in text.splitlines():
        time, is_solved, *levels = line.split()
        numbers = [float(word) for word in levels]
        ticks.append(Tick(float(time), is_solved == "1", numbers[0::2],
                          numbers[1::2]))
    return ticks


def fastest(passes):
    """Returns the ticks of the first pass, with the least time of all."""
    return [ticks[0]._replace(time=min(tick.time for tick in ticks))
            for ticks in zip(*passes)]


def quantile(values, fraction):
    """Returns the smallest value with at least `fraction` of all up to it."""
    ordered = sorted(values)
    return ordered[max(math.ceil(fraction * len(ordered)), 1) - 1]


def first_difference(costs, reference, floors):
    """Returns 1 if the first level that differs is higher, -1 if lower, or 0.

    Lower priorities than that level are not compared: it changes what is
    possible for them. NaN is higher than any cost.
    """
    for cost, wanted, floor in zip(costs, reference, floors):
        allowed = TOLERANCE * max(wanted, floor)
        if math.isnan(cost) or cost - wanted > allowed:
            return 1
        if wanted - cost > allowed:
            return -1
    return 0


def summarize(ticks, reference):
    """Returns the figures of a solver; `reference` has Poise's ticks.

    A tick that Poise does not certify has no reference and counts neither as
    wrong nor as lower.
    """
    times = [tick.time for tick in ticks]
    signs = [first_difference(tick.costs, ours.costs, ours.floors)
             for tick, ours in zip(ticks, reference) if ours.is_solved]
    percent = 100 / len(ticks)
    return Figures(
        quantile(times, 0.5), quantile(times, 0.99), max(times),
        quantile(times, 0.999), percent * sum(not tick.is_solved for tick in ticks),
        percent * signs.count(1), percent * signs.count(-1))


def row(sequence, solver, figures, ours=None):
    """Returns a row of the table; `ours` are Poise's figures for a peer."""
    cells = [sequence, solver]
    cells += [f"{time:.1f}" for time in figures[:3]]
    cells.append(f"{figures.p999 / figures.median:.1f}")
    cells.append(f"{figures.worst / figures.median:.1f}")
    cells += [f"{percent:.1f}" for percent in figures[4:]]
    cells += ["", "", ""] if ours is None else [
        f"{a / b:.2f}" for a, b in zip(ours[:3], figures[:3])]
    return "| " + " | ".join(cells) + " |"


def head():
    return ["| " + " | ".join(HEAD) + " |", "|" + " --- |" * len(HEAD)]
