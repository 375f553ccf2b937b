// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Errors of the sensors; none by default. `noise`, `bias` and `resolution`
/// scale the values below them; 0 switches them off.
struct SensorSettings {
  double noise = 0;       ///< Scale of the noise, drawn for each reading.
  double bias = 0;        ///< Scale of the biases, drawn once for each sensor.
  double resolution = 0;  ///< Scale of the steps that readings are rounded to.

  // Standard deviations of the noise.
  double joint_position = 2e-3;    ///< rad or m.
  double joint_velocity = 0.1;     ///< rad/s or m/s.
  double base_position = 0;        ///< m.
  double base_orientation = 4e-3;  ///< rad.
  double base_rate = 0.02;         ///< rad/s.
  double base_velocity = 0;        ///< m/s.
  double foot_force = 2;           ///< N.
  double foot_moment = 0.1;        ///< N m.
  double accelerometer = 0.05;     ///< m/s2.
  double gyroscope = 5e-3;         ///< rad/s.

  double joint_bias = 0;        ///< Per joint, drawn once in +- this, rad.
  double gyroscope_bias = 0;    ///< Per axis, drawn once in +- this, rad/s.
  double force_bias = 0;        ///< Per axis, drawn once in +- this, N.
  double joint_resolution = 0;  ///< Quantisation of joint positions, rad.
  double force_resolution = 0;  ///< Quantisation of forces, N.
  double joint_delay = 0;       ///< Delay of joint readings, s.
  double base_delay = 0;        ///< Delay of the base and the IMU, s.
  double foot_delay = 0;  ///< Delay of foot wrenches and contact flags, s.
  double dropout = 0;     ///< Probability that a tick has no new reading.
  double freeze_at = 0;   ///< Time at which all readings freeze, s.
  double freeze_for = 0;  ///< Duration of the freeze, s; 0: no freeze.
  double contact_threshold = 5;  ///< Normal force of a contact flag, N.
};

}  // namespace poise
