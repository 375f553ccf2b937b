# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""A task written in Python: keep the pelvis from turning.

docs/tasks.md has the same task in C++. A task in Python is slow: it is for a
trial, not for a robot.
"""

# %%
import numpy as np
from numpy.typing import NDArray

import poise


class BaseStill(poise.Task):
    """Drives the angular velocity of the base to zero: dw/dt = -kd w."""

    kd = 10.0  # 1/s.

    def __init__(self) -> None:
        super().__init__("base_still", level=5, weight=10,
                         equalities=[f"base_still.{axis}" for axis in "xyz"])

    def rows(self, input: poise.TaskInput
             ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        # y = [vdot; wrenches of the feet], and v begins with w_WB.
        B = np.zeros((3, len(input.v) + 12))
        B[:, :3] = np.eye(3)
        return B, self.kd * input.v[:3]


# %%
robot = poise.Robot.load()
task = BaseStill()
simulation = poise.Simulation(robot, poise.Scenario.load("stand"), [task])
simulation.push([0, 80, 0], duration=0.1)
simulation.step(100)
print("angular velocity of the base, rad/s:", simulation.v[:3])
print("residual:", simulation.controller.report.residuals["base_still"])

# %% [markdown]
# An exception in rows() ends the tick in the fail-safe command.

# %%
task.kd = "fast"  # type: ignore[assignment]
simulation.step()
report = simulation.controller.report
print(report.status, report.fail_safe_reason, "-", task.error)
assert report.status == "fail_safe"
