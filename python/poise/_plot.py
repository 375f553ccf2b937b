# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The figure of Run.plot()."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt  # type: ignore[import]
import numpy as np

from poise import _poise

if TYPE_CHECKING:
    import matplotlib.figure  # type: ignore[import]
    from numpy.typing import NDArray

    from poise.run import Run

# Label of a panel: its lines, each with its column.
_PANELS = {
    "center of mass [m]": {"x, forward": "com.x", "y, left": "com.y"},
    "push [N]": {"x": "push.fx", "y": "push.fy"},
    "normal force [N]": {"left foot": "left_foot.fz",
                         "right foot": "right_foot.fz"},
}
# The desired center of mass, in the colors of the lines above it.
_REFERENCES = {"com.x": "com_ref.x", "com.y": "com_ref.y"}
_SETTLING = 0.1  # s. The soles touch the ground in this time.


def numbers_of(run: Run, name: str) -> NDArray[np.float64]:
    """Returns a column of numbers."""
    column = run[name]
    if column.dtype == object:
        raise _poise.InputError(
            f"column {name!r} has texts, must be a column of numbers")
    return column


def name_with_unit(run: Run, name: str) -> str:
    """Returns the name of a column with its unit: 'com.x[m]'."""
    for full in run.columns:
        if name in (full, full.split("[")[0]):
            return full.replace("[", " [")
    return name


def pushes_of(run: Run) -> list[tuple[float, float]]:
    """Returns the start and the end of each push, s."""
    time = numbers_of(run, "time")
    pushed = sum(numbers_of(run, f"push.f{axis}") ** 2 for axis in "xyz") > 0
    edges = np.flatnonzero(np.diff(np.concatenate([[0], pushed, [0]])))
    last = len(time) - 1
    return [(float(time[begin]), float(time[min(end, last)]))
            for begin, end in edges.reshape(-1, 2)]


def limit_height(axis: Any, time: NDArray[np.float64],
                 columns: list[NDArray[np.float64]]) -> None:
    """Fits a panel to its lines after the soles have settled.

    The impact of the soles at the start would flatten all that follows.
    """
    settled = time > time[0] + _SETTLING
    values = np.concatenate([column[settled] for column in columns])
    values = values[np.isfinite(values)]
    if len(values) == 0:
        return
    low, high = values.min(), values.max()
    margin = 0.08 * (high - low) or 0.08 * abs(high) or 1.0
    axis.set_ylim(low - margin, high + margin)


def draw_panel(axis: Any, run: Run, lines: dict[str, str]) -> None:
    """Draws the lines of a panel."""
    time, columns = numbers_of(run, "time"), []
    for label, name in lines.items():
        columns.append(numbers_of(run, name))
        (line,) = axis.plot(time, columns[-1], label=label)
        reference = _REFERENCES.get(name.split("[")[0])
        if reference:
            axis.plot(time, numbers_of(run, reference), "--",
                      color=line.get_color(), linewidth=0.8,
                      label=label.split(",")[0] + ", desired")
    limit_height(axis, time, columns)
    if len(axis.lines) > 1:
        axis.legend(loc="upper right", frameon=False)
    axis.grid(alpha=0.3)
    axis.spines[["top", "right"]].set_visible(False)


def plot_run(run: Run, names: tuple[str, ...]) -> matplotlib.figure.Figure:
    """Returns the figure with a panel for each name, or the default panels."""
    for name in names:
        numbers_of(run, name)  # Raises InputError if the name is invalid.
    panels = {name_with_unit(run, name): {name: name}
              for name in names} or _PANELS
    pushes = pushes_of(run)
    figure, axes = plt.subplots(
        len(panels), 1, sharex=True, squeeze=False, layout="constrained",
        figsize=(7, 1 + 1.8 * len(panels)))
    for axis, (label, lines) in zip(axes[:, 0], panels.items()):
        for begin, end in pushes:
            axis.axvspan(begin, end, color="0.9", linewidth=0)
        draw_panel(axis, run, lines)
        axis.set_ylabel(label)
    figure.align_ylabels()
    axes[-1, 0].set_xlabel("time [s]; grey: push")
    recovered = "recovered" if run.recovered else "not recovered"
    figure.suptitle(f"{run.folder.name}: {recovered}", fontsize="medium")
    return figure
