// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "math/so3.h"

namespace poise {

Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& w) noexcept {
  const double angle = w.stableNorm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R) noexcept {
  const Eigen::AngleAxisd a(R);
  return a.angle() * a.axis();
}

}  // namespace poise
