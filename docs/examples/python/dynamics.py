# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The dynamics of Poise beside the same quantities by hand in NumPy."""

# %%
import numpy as np

import poise

robot = poise.Robot.load()  # Or a URDF file: poise.Robot.load("my_robot.urdf").
tree = robot.tree
random = np.random.default_rng(0)
q = tree.integrate(robot.posture, random.normal(size=tree.nv), dt=0.1)
v, vdot = random.normal(size=(2, tree.nv))

# %% [markdown]
# The equation of motion M vdot + N = tau, by three algorithms.

# %%
M, N = tree.crba(q), tree.bias(q, v)
tau = tree.rnea(q, v, vdot)
print("M vdot + N - tau:", np.abs(M @ vdot + N - tau).max())
print("M^-1 (tau - N) - aba:",
      np.abs(np.linalg.solve(M, tau - N) - tree.aba(q, v, tau)).max())

# %% [markdown]
# The Jacobian of the left foot, by central differences. Positions of the foot's
# origin have error h^2, and rounding eps / h.

# %%
foot = robot.feet[0].frame
h = 1e-6
by_hand = np.column_stack([
    (tree.pose(tree.integrate(q, d, h), foot)
     - tree.pose(tree.integrate(q, d, -h), foot))[:3, 3] / (2 * h)
    for d in np.eye(tree.nv)])
print("J - differences:",
      np.abs(tree.jacobian(q, foot)[3:] - by_hand).max())

# %% [markdown]
# The center of mass by hand: the mean of the bodies' centers, weighted by their
# masses. The inertial parameters of a body begin with its mass m and with m
# times the position of its center in the body.

# %%
tick = tree.tick(q, v, [foot.frame for foot in robot.feet])
parameters = tree.inertial_parameters()[:10 * tree.num_bodies].reshape(-1, 10)
moments = [X[:3, :3] @ body[1:4] + body[0] * X[:3, 3]
           for X, body in zip(tick.poses, parameters)]
com = np.sum(moments, axis=0) / parameters[:, 0].sum()
print("center of mass - by hand:", np.abs(tick.com - com).max())

# %% [markdown]
# A tick has everything of a control tick at once, in arrays that the next call
# reuses.

# %%
for _ in range(3):
    tree.tick(q, v, out=tick)
print("momentum [angular; linear]:", np.round(tick.L_G, 3))
assert np.allclose(tick.M, M) and np.allclose(tick.H_G @ v, tick.L_G)
assert np.allclose(tick.com, com)
