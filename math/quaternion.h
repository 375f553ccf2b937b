// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "poise/math/stumpff.h"

namespace poise {

/// The unit quaternion of R_AB, with w >= 0. Stored (x, y, z, w), as in q.
///
/// pre: R is a rotation; one that is off by e gives a quaternion off by O(e).
/// The component that is divided by is at least 1/2, so no angle is worse than
/// another: error at most 4 eps. A NaN or an infinity gives NaN in all.
/// Source: Shepperd, "Quaternion from rotation matrix", JGC 1(3), 1978.
Eigen::Quaterniond QuaternionFromMatrix(const Eigen::Matrix3d& R) noexcept;

/// Whether a sum of squares lost no digits, and did not overflow.
inline bool IsSafeSquare(double square) noexcept {
  return square > 1e-200 && square < 1e200;
}

/// q over its largest component. Of 0, a NaN or an infinity NaN in all.
Eigen::Quaterniond Rescale(const Eigen::Quaterniond& q) noexcept;

/// The unit quaternion in the direction of q, whatever its norm. Of 0, which
/// has none, of a NaN or an infinity NaN in all.
inline Eigen::Quaterniond Normalize(const Eigen::Quaterniond& q) noexcept {
  const double square = q.squaredNorm();
  if (!IsSafeSquare(square)) return Rescale(q).normalized();
  return Eigen::Quaterniond(q.coeffs() / std::sqrt(square));
}

/// The rotation matrix of a unit quaternion: 1 - 2 (y² + z²), ... The inverse
/// of QuaternionFromMatrix(). Of q and -q the same.
inline Eigen::Matrix3d MatrixFromQuaternion(
    const Eigen::Quaterniond& q) noexcept {
  return q.toRotationMatrix();
}

/// The unit quaternion of the rotation by |w| about w, for any |w|:
///     [sin(|w|/2) w/|w|; cos(|w|/2)].
/// Error as ExpSo3(). A NaN, an infinity or |w| > 1e154 gives NaN in all.
inline Eigen::Quaterniond ExpQuaternion(const Eigen::Vector3d& w) noexcept {
  const Eigen::Vector3d half = 0.5 * w;
  const Stumpff c = ComputeStumpff(half);
  return {1 - c.c2 * half.squaredNorm(), c.c1 * half.x(), c.c1 * half.y(),
          c.c1 * half.z()};
}

/// The rotation vector of norm at most π of q; q and -q have the same.
///
/// q may have any norm: only its direction counts. Error as LogSo3(). 0, which
/// has none, a NaN or an infinity gives NaN in all.
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
  // The square of a tiny x may have been rounded, but atan2(x, y) / x is the
  // same for both. Only where it came to nothing is there nothing to divide by.
  const double sine = std::sqrt(square);
  if (sine == 0) return 2 / w * v;
  return std::copysign(2 / sine, w) * std::atan2(sine, std::abs(w)) * v;
}

/// (w, x, y, z), the order of URDF tools, MuJoCo and most books. For borders.
inline Eigen::Vector4d WxyzFromQuaternion(
    const Eigen::Quaterniond& q) noexcept {
  return {q.w(), q.x(), q.y(), q.z()};
}

/// The inverse of WxyzFromQuaternion().
inline Eigen::Quaterniond QuaternionFromWxyz(
    const Eigen::Vector4d& wxyz) noexcept {
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

/// A rotation drawn uniformly, from three numbers drawn uniformly in [0, 1).
///
/// Source: Shoemake, "Uniform random rotations", Graphics Gems III, 1992.
Eigen::Quaterniond UniformQuaternion(const Eigen::Vector3d& u) noexcept;

}  // namespace poise
