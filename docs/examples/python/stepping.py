# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Simulates one shove twice: standing on both feet, then with steps."""

# %%
import matplotlib.pyplot as plt

import poise

robot = poise.Robot.load()
runs = {}
for steps in (False, True):
    scenario = poise.Scenario.load("shove")
    scenario.steps = steps
    scenario.duration = 4.0
    run = poise.run(scenario, robot)
    runs[steps] = run
    print("steps:", steps, "- recovered:", run.recovered)
    print(run.explain(), end="\n\n")
assert runs[True].recovered and not runs[False].recovered

# %%
figure, axis = plt.subplots(figsize=(7, 3))
for steps, run in runs.items():
    axis.plot(run["time"], run["com.z"],
              label="with steps" if steps else "in place")
axis.set_xlabel("time [s]")
axis.set_ylabel("height of the center of mass [m]")
axis.grid(alpha=0.3)
axis.legend()
figure.savefig("stepping.png", bbox_inches="tight")

# %%
runs[True]  # A notebook shows the report: the 3D replay.
