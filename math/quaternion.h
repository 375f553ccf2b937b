// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "poise/math/stumpff.h"

namespace poise {

/// Returns the unit quaternion of R_AB, with w >= 0. Stored (x, y, z, w), as in
/// q.
///
/// pre: R is a rotation. An error e of R gives an error O(e) of the quaternion.
/// The error is at most 4 eps for all angles, because each divisor is at least
/// 1/2. A NaN or an infinity gives NaN in all components.
/// Source: Shepperd, "Quaternion from rotation matrix", JGC 1(3), 1978.
Eigen::Quaterniond QuaternionFromMatrix(const Eigen::Matrix3d& R) noexcept;

/// Returns whether a sum of squares neither underflows nor overflows.
inline bool IsSafeSquare(double square) noexcept {
  return square > 1e-200 && square < 1e200;
}

/// Returns q divided by its largest component. Zero, a NaN or an infinity gives
/// NaN in all components.
Eigen::Quaterniond Rescale(const Eigen::Quaterniond& q) noexcept;

/// Returns the unit quaternion in the direction of q, for any norm of q but 0.
/// Zero, a NaN or an infinity gives NaN in all components.
inline Eigen::Quaterniond Normalize(const Eigen::Quaterniond& q) noexcept {
  const double square = q.squaredNorm();
  if (!IsSafeSquare(square)) return Rescale(q).normalized();
  return Eigen::Quaterniond(q.coeffs() / std::sqrt(square));
}

/// Returns the rotation matrix of a unit quaternion: 1 - 2 (y² + z²), ... It is
/// the inverse of QuaternionFromMatrix(). q and -q give the same matrix.
inline Eigen::Matrix3d MatrixFromQuaternion(
    const Eigen::Quaterniond& q) noexcept {
  return q.toRotationMatrix();
}

/// Returns the unit quaternion of the rotation by |w| about w, for any |w|:
///     [sin(|w|/2) w/|w|; cos(|w|/2)].
/// The error is that of ExpSo3(). A NaN, an infinity or |w| > 1e154 gives NaN
/// in all components.
inline Eigen::Quaterniond ExpQuaternion(const Eigen::Vector3d& w) noexcept {
  const Eigen::Vector3d half = 0.5 * w;
  const Stumpff c = ComputeStumpff(half);
  return {1 - c.c2 * half.squaredNorm(), c.c1 * half.x(), c.c1 * half.y(),
          c.c1 * half.z()};
}

/// Returns the rotation vector of q, of norm at most π. q and -q give the same
/// vector.
///
/// q may have any norm but 0. The error is that of LogSo3(). Zero, a NaN or an
/// infinity gives NaN in all components.
inline Eigen::Vector3d LogQuaternion(const Eigen::Quaterniond& q) noexcept {
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

/// Returns (w, x, y, z), the order of URDF tools, MuJoCo and most books. Use it
/// at the borders of the program.
inline Eigen::Vector4d WxyzFromQuaternion(
    const Eigen::Quaterniond& q) noexcept {
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Returns the quaternion of (w, x, y, z), the inverse of WxyzFromQuaternion().
inline Eigen::Quaterniond QuaternionFromWxyz(
    const Eigen::Vector4d& wxyz) noexcept {
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

/// Returns a uniformly distributed rotation, from three numbers that are
/// uniformly distributed in [0, 1).
///
/// Source: Shoemake, "Uniform random rotations", Graphics Gems III, 1992.
Eigen::Quaterniond UniformQuaternion(const Eigen::Vector3d& u) noexcept;

}  // namespace poise
