# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""A hierarchy of three levels, and the explanation of its answer.

A hand at y = (x, z) must stay below the ceiling z = 1, is to reach the point
(2, 3), and shall stay near the line x = z. A level has the rows B y + b = 0, so b is
minus the point.
"""

# %%
import numpy as np

import poise

hierarchy = poise.Hierarchy(2)
hierarchy.add_level(name="room", C=[[0, 1]], upper=[1],
                    inequality_names=["ceiling"])
hierarchy.add_level(name="reach", B=np.eye(2), b=[-2, -3],
                    equality_names=["x", "z"])
hierarchy.add_level(name="line", B=[[1, -1]], b=[0])

# %%
solver = poise.Solver(2)
solution = solver.solve(hierarchy)
print("y =", solution.y, "certificate", solution.certificate.worst)
print(solution.explain())
print("Rows that contradict each other:", solution.conflict(1))
assert np.allclose(solution.y, [2, 1])

# %% [markdown]
# The solver starts from its last answer, so a similar problem is quick.

# %%
again = solver.solve(hierarchy)
print("iterations:", solution.iterations, "cold,", again.iterations, "warm")
