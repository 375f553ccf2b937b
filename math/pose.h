// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// The pose X_AB of a frame B in a frame A, an element of SE(3):
///     p_AQ_A = X_AB p_BQ_B = R p_BQ_B + p.
/// Adjacent letters must match: X_AC = X_AB * X_BC.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_AB.
  Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< p_AB_A, m.

  Pose Inverse() const noexcept {
    return {R.transpose(), -(R.transpose() * p)};
  }
};

inline Pose operator*(const Pose& X_AB, const Pose& X_BC) noexcept {
  return {X_AB.R * X_BC.R, X_AB.R * X_BC.p + X_AB.p};
}

/// The point p_BQ_B, as p_AQ_A.
inline Eigen::Vector3d operator*(const Pose& X_AB,
                                 const Eigen::Vector3d& p_BQ_B) noexcept {
  return X_AB.R * p_BQ_B + X_AB.p;
}

}  // namespace poise
