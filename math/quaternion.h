// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "math/stumpff.h"

namespace poise {

/// The unit quaternion of R_AB, with w >= 0. Stored (x, y, z, w), as in q.
///
/// pre: R is a rotation; one that is off by e gives a quaternion off by O(e).
/// The component that is divided by is at least 1/2, so no angle is worse than
/// another: error at most 4 eps. A NaN or an infinity gives NaN in all.
/// Source: Shepperd, "Quaternion from rotation matrix", JGC 1(3), 1978.
Eigen::Quaterniond QuaternionFromMatrix(const Eigen::Matrix3d& R) noexcept;

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
/// q need not have norm 1 exactly: only its direction is used. Error as
/// LogSo3(). A NaN or an infinity gives NaN in all.
inline Eigen::Vector3d LogQuaternion(const Eigen::Quaterniond& q) noexcept {
  const double sine = q.vec().norm();
  const double w = q.w();
  // The square of a tiny x may have been rounded, but atan2(x, y) / x is the
  // same for both. Only where it came to nothing is there nothing to divide by.
  // What is added is nothing, or NaN.
  if (sine == 0) return (2 / w + 0 * w) * q.vec();
  const double inverse = 2 / sine + 0 * (sine + w);
  const double half =
      std::signbit(w) ? std::atan2(-sine, -w) : std::atan2(sine, w);
  return inverse * half * q.vec();
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
