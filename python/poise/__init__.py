# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Momentum control of humanoids, rigid-body dynamics and hierarchical QPs.

Units are SI and radians. Spatial vectors have the angular part first.
Quaternions are x, y, z, w. Arrays are NumPy arrays of float64. An input that
cannot be used raises InputError, a ValueError, which says what was wanted.
"""

import pathlib as _pathlib

from poise import _poise
from poise import se3, so3
from poise._poise import (
    CenterOfMass,
    CentroidalMomentum,
    Certificate,
    Command,
    Controller,
    Derivatives,
    Diagnosis,
    Finding,
    Foot,
    FrameTick,
    Hierarchy,
    InputError,
    Level,
    LevelSolution,
    Parameters,
    ReportRow,
    Robot,
    Scenario,
    Simulation,
    Sole,
    Solution,
    Solver,
    Stack,
    StackTask,
    State,
    Task,
    TaskInput,
    Tick,
    TickReport,
    Tree,
    doctor,
)
from poise.run import Run, run

_poise._set_data_folder(_pathlib.Path(__file__).parent / "data")

__version__ = "0.9.0"

__all__ = [
    "CenterOfMass",
    "CentroidalMomentum",
    "Certificate",
    "Command",
    "Controller",
    "Derivatives",
    "Diagnosis",
    "Finding",
    "Foot",
    "FrameTick",
    "Hierarchy",
    "InputError",
    "Level",
    "LevelSolution",
    "Parameters",
    "ReportRow",
    "Robot",
    "Run",
    "Scenario",
    "Simulation",
    "Sole",
    "Solution",
    "Solver",
    "Stack",
    "StackTask",
    "State",
    "Task",
    "TaskInput",
    "Tick",
    "TickReport",
    "Tree",
    "doctor",
    "run",
    "se3",
    "so3",
]
