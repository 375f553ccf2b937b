// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"

namespace poise {

/// Measured contact wrench of one foot, about and in the axes of its contact
/// frame C.
struct FootMeasurement {
  Eigen::Matrix<double, 6, 1> F_Co_C;  ///< [torque; force] from the ground.
  bool in_contact = true;
};

/// Sensor values of a robot, or of a simulated plant, at one instant. Resize
/// the vectors only once, before the control loop.
struct Measurement {
  double time = 0;           ///< Clock of the sensors, s.
  Eigen::VectorXd q_joints;  ///< By joint of the tree, rad or m.
  Eigen::VectorXd v_joints;  ///< rad/s or m/s.

  /// Base pose and twist, as a simulator or motion capture gives them.
  Pose X_WB;
  Eigen::Matrix<double, 6, 1> V_WB_W;  ///< [w; v of the base's origin].

  /// Inertial measurement unit at the base's origin, in the base's axes.
  Eigen::Vector3d w_WB_B;               ///< Gyroscope, rad/s.
  Eigen::Vector3d specific_force_Bo_B;  ///< Accelerometer: a - g, m/s2.
  Eigen::Matrix3d R_WB_imu;             ///< Orientation estimate of the unit.

  std::vector<FootMeasurement> feet;  ///< In the order of the robot's feet.
};

/// Whether all values are finite and below 1e6 (in m or rad, also per s or s2).
/// For larger values, the dynamics would overflow. Does not allocate.
bool IsBelievable(const Eigen::Ref<const Eigen::MatrixXd>& x) noexcept;

/// Estimated state of the robot, the input of the controller. dynamics/tree.h
/// defines q and v.
struct State {
  double time = 0;    ///< s.
  Eigen::VectorXd q;  ///< nq.
  Eigen::VectorXd v;  ///< nv.
};

}  // namespace poise
