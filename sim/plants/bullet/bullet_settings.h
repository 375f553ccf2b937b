// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Settings of Bullet. bullet_settings_test.cc measures the effect of each.
/// These defaults give correct physics; most of Bullet's own defaults do not.
struct BulletSettings {
  bool own_sweeps = true;               ///< Uses ContactSolver, not Bullet's.
  int solver_iterations = 50;           ///< With Bullet's 10 the feet creep.
  double residual_threshold = 0;        ///< If larger, sweeps end too early.
  double linear_damping = 0;            ///< Bullet's 0.04 loses energy.
  double angular_damping = 0;           ///< Bullet's 0.04 loses energy.
  bool gyroscopic_term = true;          ///< Without it angular momentum drifts.
  bool rk4 = false;                     ///< True differs from textbook RK4.
  bool global_velocities = false;       ///< True gives wrong accelerations.
  bool can_sleep = false;               ///< A sleeping body ignores forces.
  double max_velocity = 1e9;            ///< Bullet's 100 rad/s clamps fingers.
  bool two_friction_directions = true;  ///< With one, feet drift sideways.
  double sole_radius = 0.005;           ///< Spheres at a sole's corners, m.
};

}  // namespace poise
