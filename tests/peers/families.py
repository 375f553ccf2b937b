# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Families of random problems in the format hqp-1, drawn from seeds."""

import collections
import json
import random

SEEDS = (1, 2, 3)

Family = collections.namedtuple("Family", "name draw")


def draw_row(draw, variables):
    return [draw.gauss(0, 1) for _ in range(variables)]


def combine(draw, rows):
    """Returns a random combination of two rows."""
    one, other = draw.choice(rows), draw.choice(rows)
    factors = draw.gauss(0, 1), draw.gauss(0, 1)
    return [factors[0] * a + factors[1] * b for a, b in zip(one, other)]


def draw_level(draw, variables, equalities, inequalities, two_sided):
    """Returns a level of normal rows, targets and bounds."""
    upper = [draw.gauss(0, 1) for _ in range(inequalities)]
    lower = [bound - draw.random() if draw.random() < two_sided else None
             for bound in upper]
    return {
        "B": [draw_row(draw, variables) for _ in range(equalities)],
        "b": [draw.gauss(0, 1) for _ in range(equalities)],
        "C": [draw_row(draw, variables) for _ in range(inequalities)],
        "lower": lower,
        "upper": upper,
    }


def dense(rows, two_sided):
    """Returns a family: 5 levels of 6 equalities and dense inequalities."""
    def draw_levels(draw):
        return 68, [draw_level(draw, 68, 6, rows, two_sided)
                    for _ in range(5)]
    return draw_levels


def deficient(draw):
    """5 levels of 14 equalities of rank 10 at most, and 10 inequalities.

    The dependent rows are combinations of rows of the same level and of the
    levels above, with targets that cannot be met.
    """
    levels, above = [], []
    for _ in range(5):
        level = draw_level(draw, 68, 10, 10, 0)
        above += level["B"]
        level["B"] += [combine(draw, above) for _ in range(4)]
        level["b"] += [draw.gauss(0, 1) for _ in range(4)]
        levels.append(level)
    return 68, levels


def mixed(draw):
    """40 variables, 5 levels of mixed sizes, a fifth of the rows dependent."""
    levels, above = [], []
    for _ in range(5):
        level = draw_level(draw, 40, draw.randint(2, 10),
                           draw.randint(10, 25), 0.5)
        for rows in (level["B"], level["C"]):
            for i in range(len(rows)):
                if above and draw.random() < 0.2:
                    rows[i] = combine(draw, above)
                above.append(rows[i])
        levels.append(level)
    return 40, levels


FAMILIES = (
    Family("dense, 5 x 40 one-sided", dense(40, 0)),
    Family("dense, 5 x 50 one-sided", dense(50, 0)),
    Family("dense, 5 x 60 one-sided", dense(60, 0)),
    Family("dense, 5 x 50 two-sided", dense(50, 1)),
    Family("deficient equalities", deficient),
    Family("random, 40 variables", mixed),
)


def write(family, seed, path):
    """Writes a problem; the same seed gives the same file."""
    variables, levels = family.draw(random.Random(seed))
    path.write_text(json.dumps({
        "format": "hqp-1", "variables": variables, "levels": levels}))
