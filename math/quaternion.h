// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>

#include "poise/math/eigen_alignment.h"

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
Eigen::Quaterniond Normalize(const Eigen::Quaterniond& q) noexcept;

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
Eigen::Quaterniond ExpQuaternion(const Eigen::Vector3d& w) noexcept;

/// Returns the rotation vector of q, of norm at most π. q and -q give the same
/// vector.
///
/// q may have any norm but 0. The error is that of LogSo3(). Zero, a NaN or an
/// infinity gives NaN in all components.
Eigen::Vector3d LogQuaternion(const Eigen::Quaterniond& q) noexcept;

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
