# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""A push in 15 lines, with a plot."""

# %%
import poise

scenario = poise.Scenario.load("stand")
scenario.duration = 4.0
scenario.add_push(force=[0, 100, 0], at=1.0, duration=0.15)  # N, s.
run = poise.run(scenario)
print("recovered:", run.recovered)
print(run.explain())
sway = run["com.y"] - run["com_ref.y"]
print(f"largest sway: {1000 * abs(sway).max():.1f} mm")

# %%
figure = run.plot()
figure.savefig("push.png")
figure  # A notebook shows it.

# %%
print("open", run.report("push.html"))
run  # A notebook shows the report: the 3D replay.
