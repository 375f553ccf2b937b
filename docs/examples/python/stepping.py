# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The same shove twice: on two feet only, and with steps."""

import sys

import poise

robot = poise.Robot.load()
for steps in False, True:
    scenario = poise.Scenario.load("shove")
    scenario.steps = steps
    if len(sys.argv) > 1:
        scenario.duration = float(sys.argv[1])
    run = poise.run(scenario, robot)
    print("steps:", steps, "- recovered:", run.recovered)
    print(run.explain(), end="\n\n")
