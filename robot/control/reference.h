// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "poise/math/pose.h"

namespace poise {

/// Desired pose, twist and acceleration of a frame F.
struct FrameReference {
  Pose X_WF;
  /// [angular; linear], rad/s and m/s.
  Eigen::Matrix<double, 6, 1> V_WF_W = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> A_WF_W = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Desired motion of the center of mass in the plane, as that of a linear
/// inverted pendulum: a_WG = omega^2 (p_WG - p_WZ). MomentumTask then uses the
/// height of Reference::p_WG, and no gains in the plane.
struct PendulumReference {
  bool is_on = false;
  Eigen::Vector2d p_WZ = Eigen::Vector2d::Zero();  ///< Desired CoP, m.
  double omega = 0;                                ///< Pendulum frequency, 1/s.
  double angular_weight = 1;  ///< Weight of the angular rows.
  double height_weight = 1;   ///< Weight of the vertical row.
  /// Upper bound of the desired vertical acceleration, m/s2.
  double max_rise = std::numeric_limits<double>::infinity();
};

/// Desired motion of the robot. The caller writes it between two ticks; tasks
/// read it.
struct Reference {
  Eigen::Vector3d p_WG = Eigen::Vector3d::Zero();  ///< Center of mass, m.
  Eigen::Vector3d v_WG = Eigen::Vector3d::Zero();  ///< m/s.
  Eigen::Vector3d a_WG = Eigen::Vector3d::Zero();  ///< m/s2.
  PendulumReference pendulum;  ///< If on, replaces p_WG in the plane.
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();  ///< Base orientation.
  Eigen::VectorXd posture;                             ///< By joint, rad or m.
  bool may_release = true;             ///< BalanceMonitor may release a foot.
  double ground_z = 0;                 ///< Height of the floor, m.
  std::vector<FrameReference> feet;    ///< Stance writes feet in the air.
  std::vector<FrameReference> frames;  ///< By ControllerOptions::frames.
};

}  // namespace poise
