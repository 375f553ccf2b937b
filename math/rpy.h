// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

// Roll, pitch and yaw as URDF means them: fixed axes x, y, z in turn. For files
// and screens only; nothing here is computed with them.

/// R = Rz(yaw) Ry(pitch) Rx(roll), of rpy = (roll, pitch, yaw).
Eigen::Matrix3d MatrixFromRpy(const Eigen::Vector3d& rpy) noexcept;

/// The inverse of MatrixFromRpy(), with |pitch| <= π/2 and |roll|, |yaw| <= π.
/// Where R(2, 1) = R(2, 2) = 0 (pitch ± π/2 exactly) roll and yaw are not
/// unique, and roll is 0. A NaN or an infinity gives NaN in all.
Eigen::Vector3d RpyFromMatrix(const Eigen::Matrix3d& R) noexcept;

}  // namespace poise
