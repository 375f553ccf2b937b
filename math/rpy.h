// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

// Roll, pitch and yaw have the meaning of URDF: rotations about the fixed axes
// x, y, z in this order. Only files and displays use them, no algorithm does.

/// Returns R = Rz(yaw) Ry(pitch) Rx(roll) for rpy = (roll, pitch, yaw).
Eigen::Matrix3d MatrixFromRpy(const Eigen::Vector3d& rpy) noexcept;

/// Returns rpy of R, the inverse of MatrixFromRpy(), with |pitch| <= π/2, and
/// with roll and yaw in [-π, π]. If R(2, 1) = R(2, 2) = 0 (pitch exactly ±
/// π/2), roll and yaw are not unique, and roll is 0. A NaN or an infinity gives
/// NaN in all components.
Eigen::Vector3d RpyFromMatrix(const Eigen::Matrix3d& R) noexcept;

}  // namespace poise
