// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/quaternion.h"

#include <cmath>

namespace poise {

Eigen::Quaterniond QuaternionFromMatrix(const Eigen::Matrix3d& R) noexcept {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  // Adds zero, or NaN to all components if an entry of R is not finite.
  q.coeffs().array() += 0 * q.coeffs().sum();
  return q;
}

Eigen::Quaterniond Rescale(const Eigen::Quaterniond& q) noexcept {
  const Eigen::Vector4d x = q.coeffs() / q.coeffs().lpNorm<Eigen::Infinity>();
  // Adds zero, or NaN to all components if one of them is not finite.
  return Eigen::Quaterniond(Eigen::Vector4d(x.array() + 0 * x.sum()));
}

Eigen::Quaterniond UniformQuaternion(const Eigen::Vector3d& u) noexcept {
  const double a = std::sqrt(1 - u[0]), b = std::sqrt(u[0]);
  const double s = 2 * M_PI * u[1], t = 2 * M_PI * u[2];
  return {b * std::cos(t), a * std::sin(s), a * std::cos(s), b * std::sin(t)};
}

}  // namespace poise
