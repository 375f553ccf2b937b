// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Settings of Bullet. bullet_settings_test.cc shows the effect of each. Most of
/// Bullet's own defaults have wrong physics.
struct BulletSettings {
  bool own_sweeps = true;               ///< See ContactSolver; else Bullet's.
  int solver_iterations = 50;           ///< Bullet's 10 let the feet creep.
  double residual_threshold = 0;        ///< More ends Bullet's sweeps early.
  double linear_damping = 0;            ///< Bullet's 0.04 eats energy.
  double angular_damping = 0;           ///< See above.
  bool gyroscopic_term = true;          ///< Without it angular momentum drifts.
  bool rk4 = false;                     ///< On, it is not the RK4 of the book.
  bool global_velocities = false;       ///< On, the accelerations are wrong.
  bool can_sleep = false;               ///< A sleeping body ignores forces.
  double max_velocity = 1e9;            ///< Bullet's 100 rad/s clamps fingers.
  bool two_friction_directions = true;  ///< One lets a foot drift sideways.
  double sole_radius = 0.005;           ///< Spheres at a sole's corners, m.
};

}  // namespace poise
