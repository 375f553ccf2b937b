// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/quaternion.h"

#include <cmath>

#include "poise/math/stumpff.h"

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

Eigen::Quaterniond Normalize(const Eigen::Quaterniond& q) noexcept {
  const double square = q.squaredNorm();
  if (!IsSafeSquare(square)) return Rescale(q).normalized();
  return Eigen::Quaterniond(q.coeffs() / std::sqrt(square));
}

Eigen::Quaterniond ExpQuaternion(const Eigen::Vector3d& w) noexcept {
  const Eigen::Vector3d half = 0.5 * w;
  const Stumpff c = ComputeStumpff(half);
  return {1 - c.c2 * half.squaredNorm(), c.c1 * half.x(), c.c1 * half.y(),
          c.c1 * half.z()};
}

Eigen::Vector3d LogQuaternion(const Eigen::Quaterniond& q) noexcept {
  double w = q.w();
  Eigen::Vector3d v = q.vec();
  double square = v.squaredNorm();
  if (!IsSafeSquare(square + w * w)) {
    const Eigen::Quaterniond rescaled = Rescale(q);
    w = rescaled.w();
    v = rescaled.vec();
    square = v.squaredNorm();
  }
  // An underflow may round the square of a tiny sine, but atan2(x, y) / x
  // hardly depends on x there. Only a sine of zero needs a limit instead of the
  // quotient.
  const double sine = std::sqrt(square);
  if (sine == 0) return 2 / w * v;
  return std::copysign(2 / sine, w) * std::atan2(sine, std::abs(w)) * v;
}

Eigen::Quaterniond UniformQuaternion(const Eigen::Vector3d& u) noexcept {
  const double a = std::sqrt(1 - u[0]), b = std::sqrt(u[0]);
  const double s = 2 * M_PI * u[1], t = 2 * M_PI * u[2];
  return {b * std::cos(t), a * std::sin(s), a * std::cos(s), b * std::sin(t)};
}

}  // namespace poise
