// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>

namespace poise {

/// The matrix of the cross product: Hat(w) v = w x v.
inline Eigen::Matrix3d Hat(const Eigen::Vector3d& w) noexcept {
  Eigen::Matrix3d W;
  W << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return W;
}

/// The inverse of Hat(); reads the antisymmetric part of W.
inline Eigen::Vector3d Vee(const Eigen::Matrix3d& W) noexcept {
  return 0.5 * Eigen::Vector3d(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0),
                               W(1, 0) - W(0, 1));
}

/// The rotation by |w| about w: exp(Hat(w)).
Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& w) noexcept;

/// The inverse of ExpSo3(), of norm at most pi.
Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R) noexcept;

}  // namespace poise
