// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/rpy.h"

#include <cmath>

namespace poise {

Eigen::Matrix3d MatrixFromRpy(const Eigen::Vector3d& rpy) noexcept {
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]), sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

Eigen::Vector3d RpyFromMatrix(const Eigen::Matrix3d& R) noexcept {
  const double roll = std::atan2(R(2, 1), R(2, 2));
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  // Yaw is the angle of R Rx(roll)'. It stays accurate near pitch ± π/2, where
  // R(0, 0) and R(1, 0) vanish.
  const double cr = std::cos(roll), sr = std::sin(roll);
  const double yaw =
      std::atan2(sr * R(0, 2) - cr * R(0, 1), cr * R(1, 1) - sr * R(1, 2));
  // Adds zero, or NaN if an entry is not finite.
  return Eigen::Vector3d(roll, pitch, yaw).array() + 0 * R.sum();
}

}  // namespace poise
