# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Draws histograms of the times of all ticks as one SVG image."""

import html
import math

# The axis of time is logarithmic, from 10 us to 1 s.
FIRST_DECADE = 1
DECADES = 5
BINS_PER_DECADE = 12
BIN_WIDTH = 9
STRIP = 34  # Height of the histogram of one solver.
LEFT = 190
COLORS = ("#1f5fa8", "#c2571a", "#4b8b3b", "#7a4fa0")


def count(times):
    """Returns the number of ticks in each bin; the ends count in the last."""
    bins = [0] * (DECADES * BINS_PER_DECADE)
    for time in times:
        place = (math.log10(time) - FIRST_DECADE) * BINS_PER_DECADE
        bins[min(max(int(place), 0), len(bins) - 1)] += 1
    return bins


def text(x, y, words, more=""):
    return f'<text x="{x}" y="{y}"{more}>{html.escape(words)}</text>'


def strip(name, times, color, top):
    """Returns a histogram. A bin with one tick has a bar that can be seen."""
    bins = count(times)
    base = top + STRIP - 4
    parts = [text(LEFT - 8, base - 2, name, ' text-anchor="end"'),
             f'<path d="M{LEFT} {base}h{len(bins) * BIN_WIDTH}" '
             'stroke="#bbb"/>']
    for i, number in enumerate(bins):
        if number == 0:
            continue
        height = 2 + (STRIP - 10) * number / max(bins)
        parts.append(f'<rect x="{LEFT + i * BIN_WIDTH}" '
                     f'y="{base - height:.1f}" width="{BIN_WIDTH - 1}" '
                     f'height="{height:.1f}" fill="{color}"/>')
    return parts


def axis(top, bottom):
    """Returns vertical lines at the decades, with their times below."""
    parts = []
    for i in range(DECADES + 1):
        x = LEFT + i * BINS_PER_DECADE * BIN_WIDTH
        power = FIRST_DECADE + i
        label = (f"{10 ** power} µs" if power < 3 else
                 f"{10 ** (power - 3)} ms" if power < 6 else "1 s")
        parts.append(f'<path d="M{x} {top}V{bottom}" stroke="#ddd"/>')
        parts.append(text(x, bottom + 16, label, ' text-anchor="middle"'))
    return parts


def draw(sequences):
    """Returns an image of {sequence: {solver: times in us}}."""
    parts, top = [], 10
    for sequence, solvers in sequences.items():
        parts.append(text(8, top + 14, sequence, ' font-weight="bold"'))
        for i, (name, times) in enumerate(solvers.items()):
            parts += strip(name, times, COLORS[i % len(COLORS)], top)
            top += STRIP
        top += 14
    width = LEFT + DECADES * BINS_PER_DECADE * BIN_WIDTH + 40
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" '
        f'height="{top + 24}" font-family="sans-serif" font-size="13">',
        '<rect width="100%" height="100%" fill="white"/>',
        *axis(10, top), *parts, "</svg>"]) + "\n"
