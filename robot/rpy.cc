// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/rpy.h"

#include <Eigen/Geometry>
#include <cmath>

namespace poise {

Eigen::Matrix3d RotationFromRpy(const Eigen::Vector3d& rpy) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
          AngleAxisd(rpy.y(), Vector3d::UnitY()) *
          AngleAxisd(rpy.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d RpyFromRotation(const Eigen::Matrix3d& R) {
  // The first column is (cy cp, sy cp, -sp), the last row (-sp, cp sr, cp cr).
  const double cos_pitch = std::hypot(R(2, 1), R(2, 2));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  // Below this, roll and yaw turn about the same axis, up to rounding.
  constexpr double kGimbalLock = 1e-8;
  if (cos_pitch < kGimbalLock) {
    return {0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  }
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace poise
