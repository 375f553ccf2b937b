// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "math/quaternion.h"

#include <cmath>

#include "math/stumpff.h"

namespace poise {

Eigen::Quaterniond QuaternionFromMatrix(const Eigen::Matrix3d& R) noexcept {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  // Adds nothing, or NaN where an entry is not finite.
  q.coeffs().array() += 0 * R.sum();
  return q;
}

Eigen::Quaterniond ExpQuaternion(const Eigen::Vector3d& w) noexcept {
  const Eigen::Vector3d half = 0.5 * w;
  const Stumpff c = ComputeStumpff(half);
  return {1 - c.c2 * half.squaredNorm(), c.c1 * half.x(), c.c1 * half.y(),
          c.c1 * half.z()};
}

Eigen::Vector3d LogQuaternion(const Eigen::Quaterniond& q) noexcept {
  const double sine = q.vec().norm();
  const double cosine = std::abs(q.w());
  // atan2(x, y) / x is good to the last digit for any x but 0: if the square
  // of a tiny x was rounded, both x are the same.
  const double scale =
      2 * (sine == 0 ? 1 / cosine : std::atan2(sine, cosine) / sine);
  // Adds nothing, or NaN where an entry is not finite.
  return ((q.w() < 0 ? -scale : scale) * q.vec()).array() +
         0 * q.coeffs().sum();
}

Eigen::Quaterniond UniformQuaternion(const Eigen::Vector3d& u) noexcept {
  const double a = std::sqrt(1 - u[0]), b = std::sqrt(u[0]);
  const double s = 2 * M_PI * u[1], t = 2 * M_PI * u[2];
  return {b * std::cos(t), a * std::sin(s), a * std::cos(s), b * std::sin(t)};
}

}  // namespace poise
