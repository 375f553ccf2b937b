// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// What is wrong with the sensors: nothing, by default. `noise` scales the
/// standard deviations below it; 0 leaves them all out.
struct SensorSettings {
  double noise = 0;                ///< Factor on what follows, up to bias.
  double joint_position = 2e-3;    ///< rad or m.
  double joint_velocity = 0.1;     ///< rad/s or m/s.
  double base_orientation = 4e-3;  ///< rad.
  double base_rate = 0.02;         ///< rad/s.
  double foot_force = 2;           ///< N.
  double foot_moment = 0.1;        ///< N m.
  double accelerometer = 0.05;     ///< m/s2.
  double gyroscope = 5e-3;         ///< rad/s.

  double joint_bias = 0;        ///< Of each joint, drawn once in +- this, rad.
  double gyroscope_bias = 0;    ///< Of each axis, drawn once in +- this, rad/s.
  double force_bias = 0;        ///< Of each axis, drawn once in +- this, N.
  double joint_resolution = 0;  ///< Quantisation of joint positions, rad.
  double force_resolution = 0;  ///< Quantisation of forces, N.
  double dropout = 0;           ///< Chance that a tick brings nothing new.
  double freeze_at = 0;         ///< From here on nothing new comes, s,
  double freeze_for = 0;        ///< for so long, s.
  double contact_threshold = 5;  ///< Normal force of a contact flag, N.
};

}  // namespace poise
