# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Recorded runs: their columns, plots, explanation and report."""

from __future__ import annotations

import html
import json
import os
import pathlib
import shutil
import tempfile
import weakref
from typing import TYPE_CHECKING, Any

from poise import _poise

# NumPy is loaded with the first array: `import poise` alone is quick.
if TYPE_CHECKING:
    import matplotlib.figure  # type: ignore[import]
    import pandas  # type: ignore[import]
    from numpy.typing import NDArray

    Column = NDArray[Any]  # float64, or object for texts.


def run(scenario: _poise.Scenario | str | os.PathLike[str],
        robot: _poise.Robot | None = None,
        out: str | os.PathLike[str] | None = None,
        *, binary: bool = False, meshes: bool = True,
        tasks: list[Any] | tuple[_poise.Task, ...] = ()) -> Run:
    """Runs a scenario to its end, or until the robot is down.

    The run equals the one of `bazel run //tools:push` to the bit. Other threads
    run meanwhile; Ctrl-C stops the run.

    Args:
        scenario: A Scenario, or what Scenario.load() accepts.
        robot: Poise's humanoid by default.
        out: The folder of the run's files. By default they are in a temporary
            folder, which is removed with the Run.
        binary: Whether to write log.bin in place of log.csv, a quarter of the
            bytes; its numbers have 7 digits.
        meshes: Whether to read the robot's meshes, for the report.
        tasks: Tasks of your own.

    >>> scenario = poise.Scenario.from_dict({"duration": 0.02})
    >>> run = poise.run(scenario)
    >>> run.recovered, run["com.z"].shape
    (True, (20,))
    """
    if isinstance(scenario, (str, os.PathLike)):
        scenario = _poise.Scenario.load(scenario)
    if not isinstance(scenario, _poise.Scenario):
        raise _poise.InputError(
            f"scenario is of type {type(scenario).__name__}, must be a "
            "Scenario or its name")
    if robot is None:
        robot = _poise.Robot.load()
    if not isinstance(robot, _poise.Robot):
        raise _poise.InputError(
            f"robot is of type {type(robot).__name__}, must be a Robot")
    if not isinstance(out, (str, os.PathLike, type(None))):
        raise _poise.InputError(
            f"out is {out!r} of type {type(out).__name__}, must be a folder")
    if out == "":
        raise _poise.InputError("out is '', must be a folder")
    parent = tempfile.mkdtemp(prefix="poise-") if out is None else None
    folder = pathlib.Path(parent or "", out or scenario.name)
    try:
        table = _poise._record(robot, scenario, str(folder), binary, meshes,
                               tasks)
        result = Run(folder, table)
        result._is_temporary = parent is not None
    except BaseException:
        if parent:
            shutil.rmtree(parent, ignore_errors=True)
        raise
    if parent:
        weakref.finalize(result, shutil.rmtree, parent, ignore_errors=True)
    return result


class Run:
    """A recorded run. A notebook shows its report.

    The constructor also opens a folder that `//tools:push` wrote.
    """

    def __init__(self, folder: str | os.PathLike[str],
                 table: str = "") -> None:
        """Opens the folder of a run.

        Args:
            folder: The folder.
            table: The text that str() returns.
        """
        if folder == "" or not isinstance(folder, (str, os.PathLike)):
            raise _poise.InputError(
                f"folder is {folder!r} of type {type(folder).__name__}, must be "
                "the folder of a run")
        self.folder = pathlib.Path(folder)
        self._table = table
        self._is_temporary = False
        self._columns: dict[str, Column] | None = None
        self._summary: dict[str, Any] | None = None

    @property
    def columns(self) -> dict[str, Column]:
        """The columns of the log by name, read once: docs/log.md lists them.

        Each is an array (ticks,): float64, or object for a column of texts.
        """
        if self._columns is None:
            import numpy as np
            self._columns = {
                name: np.array(column, dtype=object)
                if isinstance(column, list) else column
                for name, column in _poise._read_log(str(self.folder)).items()}
        return self._columns

    def __getitem__(self, name: str) -> Column:
        """Returns a column by its name, with or without the unit: 'com.x'."""
        if not isinstance(name, str):
            raise _poise.InputError(
                f"column is of type {type(name).__name__}, must be a str")
        if name in self.columns:
            return self.columns[name]
        for full, column in self.columns.items():
            if full.split("[")[0] == name:
                return column
        raise _poise.InputError(
            f"column {name!r} is unknown, must be one of Run.columns, such as "
            "'time' or 'com.x'")

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and any(
            name in (full, full.split("[")[0]) for full in self.columns)

    @property
    def summary(self) -> dict[str, Any]:
        """The contents of summary.json: outcome, peaks and times."""
        if self._summary is None:
            file = self.folder / "summary.json"
            if not file.is_file():
                raise _poise.InputError(
                    f"{file} does not exist, must be the summary of a run")
            try:
                self._summary = dict(json.loads(file.read_text("utf-8")))
            except (OSError, ValueError, TypeError) as error:
                raise _poise.InputError(
                    f"{file} cannot be read, must be the summary of a run: "
                    f"{error}") from error
        return self._summary

    @property
    def recovered(self) -> bool:
        """Whether the robot recovered."""
        return bool(self.summary["recovered"])

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the columns as a DataFrame. Needs pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError(
                "Run.to_pandas() needs pandas: install python3-pandas"
            ) from error
        return pandas.DataFrame(self.columns)

    def plot(self, *names: str) -> matplotlib.figure.Figure:
        """Plots columns over time, one below the other. Needs matplotlib.

        A grey band marks each push.

        Args:
            names: Columns of numbers; the center of mass, the push and the
                normal forces of the feet by default.
        """
        try:
            import matplotlib.pyplot as plt  # type: ignore[import]
        except ImportError as error:
            raise ImportError(
                "Run.plot() needs matplotlib: install python3-matplotlib"
            ) from error
        from poise._plot import plot_run
        figure = plot_run(self, names)
        plt.close(figure)  # A notebook shows the returned figure once.
        return figure

    def report(self, file: str | os.PathLike[str] | None = None
               ) -> pathlib.Path:
        """Writes the page with the 3D replay and returns its path.

        Args:
            file: The page to write; report.html in the folder by default. A
                run in a temporary folder has no default: the page would be
                removed with the Run.
        """
        if not isinstance(file, (str, os.PathLike, type(None))):
            raise _poise.InputError(
                f"file is {file!r} of type {type(file).__name__}, must be a file")
        if file is None and self._is_temporary:
            raise _poise.InputError(
                "file is None, must be a file: the folder of this run is "
                "temporary; call report('report.html'), or run with out=FOLDER")
        page = self.folder / "report.html" if file is None else (
            pathlib.Path(file))
        _poise._write_report([str(self.folder)], str(page), [])
        return page

    def explain(self, *, all: bool = False) -> str:
        """Returns in words what happened and why, at most six sentences.

        Args:
            all: Whether to return all sentences, in order of time.
        """
        if not isinstance(all, bool):
            raise _poise.InputError(
                f"all is of type {type(all).__name__}, must be True or False")
        told = json.loads(_poise._explain(str(self.folder)))
        return "\n".join(told["sentences" if all else "story"])

    def __str__(self) -> str:
        return self._table or self.explain()

    def __repr__(self) -> str:
        try:
            return (f"<poise.Run {self.folder.name!r}, recovered: "
                    f"{self.recovered}>")
        except (_poise.InputError, KeyError):
            return f"<poise.Run {self.folder.name!r}, without a summary>"

    def _repr_html_(self) -> str:
        # A notebook must not overwrite report.html in a folder of the user.
        with tempfile.TemporaryDirectory(prefix="poise-") as place:
            page = self.report(pathlib.Path(place, "report.html")).read_text(
                encoding="utf-8")
        return (f'<iframe srcdoc="{html.escape(page)}" width="100%" '
                'height="720" style="border: 0"></iframe>')
