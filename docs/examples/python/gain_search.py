# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""A search for gains with scipy.optimize.

The momentum task drives the center of mass to its reference with the gains kp
and kd. The search looks for the gains with the smallest sway after a push.
"""

# %%
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

import poise

robot = poise.Robot.load()
scenario = poise.Scenario.from_dict({"duration": 1.0})

# %% [markdown]
# The cost of a push has two parts. High gains keep the sway of the center of
# mass small, but they move the center of pressure (CoP) to the edge of the
# soles, which leaves no margin for a second push. Each call simulates 1 s.


# %%
def cost(gains: NDArray[np.float64]) -> float:
    """Returns the integral of 10 sway^2 + CoP^2, cm2 s.

    The gains are kp, 1/s2, and kd, 1/s.
    """
    simulation = poise.Simulation(robot, scenario)
    parameters = simulation.controller.stack["momentum"].parameters
    parameters["kp"], parameters["kd"] = gains
    simulation.step(100)
    simulation.push(force=[0, 60, 0], duration=0.1)
    total = 0.0
    for _ in range(90):
        simulation.step(10)
        sway = (simulation.com - simulation.com_reference)[1]
        total += 0.01 * 1e4 * (10 * sway**2 + simulation.cop[1] ** 2)
    return float(total)


# %% [markdown]
# The Nelder-Mead method needs no derivatives, and 20 simulations are enough to
# improve the default gains.

# %%
start = np.array([30.0, 10.0])
result = minimize(cost, start, method="Nelder-Mead",
                  bounds=[(5, 200), (2, 30)], options={
                      "maxfev": 20, "initial_simplex": [
                          start, [45.0, 10.0], [30.0, 15.0]]})
print(f"kp, kd = {start}: cost {cost(start):.2f}")
print(f"kp, kd = {np.round(result.x, 1)}: cost {result.fun:.2f}, after "
      f"{result.nfev} simulations")
assert result.fun < cost(start)
