// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Errors of the sensors; none by default. `noise`, `bias` and `resolution` scale
/// the values below them; 0 switches them off.
struct SensorSettings {
  double noise = 0;       ///< Each reading is off by so much.
  double bias = 0;        ///< Each sensor is, drawn once.
  double resolution = 0;  ///< Each reading is rounded to multiples of this.

  double joint_position = 2e-3;    ///< Standard deviations: rad or m.
  double joint_velocity = 0.1;     ///< rad/s or m/s.
  double base_position = 0;        ///< m.
  double base_orientation = 4e-3;  ///< rad.
  double base_rate = 0.02;         ///< rad/s.
  double base_velocity = 0;        ///< m/s.
  double foot_force = 2;           ///< N.
  double foot_moment = 0.1;        ///< N m.
  double accelerometer = 0.05;     ///< m/s2.
  double gyroscope = 5e-3;         ///< rad/s.

  double joint_bias = 0;         ///< Per joint, drawn once in +- this, rad.
  double gyroscope_bias = 0;     ///< Per axis, drawn once in +- this, rad/s.
  double force_bias = 0;         ///< Per axis, drawn once in +- this, N.
  double joint_resolution = 0;   ///< Quantisation of joint positions, rad.
  double force_resolution = 0;   ///< Quantisation of forces, N.
  double joint_delay = 0;        ///< How old what the joints say is, s;
  double base_delay = 0;         ///< the base and the inertial unit, s;
  double foot_delay = 0;         ///< the feet and their contact flags, s.
  double dropout = 0;            ///< Chance that a tick brings nothing new.
  double freeze_at = 0;          ///< From this time on, s, nothing new comes
  double freeze_for = 0;         ///< during so many s; 0: this never happens.
  double contact_threshold = 5;  ///< Normal force of a contact flag, N.
};

}  // namespace poise
