# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Steps a simulation tick by tick and changes the stack between ticks."""

# %%
import poise

robot = poise.Robot.load()
simulation = poise.Simulation(robot, poise.Scenario.load("stand"))
simulation.step(200)  # 0.2 s.
simulation.push([0, 60, 0], duration=0.1)

# %% [markdown]
# Any task of the stack can be tuned, or switched off and on, between two ticks.

# %%
stack = simulation.controller.stack
stack["posture"].weight = 0.5
stack["angular_momentum"].enabled = True
for _ in range(5):
    simulation.step(100)
    report = simulation.controller.report
    rows = sorted(report.active, key=lambda row: -row.amount)[:3]
    print(f"{simulation.time:.1f} s, com y {simulation.com[1]:+.4f} m, "
          f"{report.status}, active:", [row.name for row in rows])
stack["angular_momentum"].enabled = False
assert not simulation.has_fallen
