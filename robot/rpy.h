// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// The rotation that URDF and profiles write as roll, pitch and yaw, rad:
///     R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Matrix3d RotationFromRpy(const Eigen::Vector3d& rpy);

/// Its inverse, with pitch in [-pi/2, pi/2], the others in [-pi, pi]; where
/// pitch is a right angle, roll is 0.
Eigen::Vector3d RpyFromRotation(const Eigen::Matrix3d& R);

}  // namespace poise
