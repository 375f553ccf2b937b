// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstring>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// Pose is the pose X_AB of a frame B in a frame A, an element of SE(3):
///     p_AQ_A = X_AB p_BQ_B = R p_BQ_B + p.
/// Adjacent letters must match: X_AC = X_AB * X_BC.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_AB.
  Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< p_AB_A, m.

  /// Returns X_BA = [R', -R' p].
  Pose Inverse() const noexcept;
};

/// Returns X_AC = [R_AB R_BC, R_AB p_BC_B + p_AB_A]. Each column is a linear
/// combination of the columns of R_AB. A vector register holds one column and
/// the first entry of the next column, which is discarded at the end.
inline Pose operator*(const Pose& X_AB, const Pose& X_BC) noexcept {
  using Four = double __attribute__((vector_size(4 * sizeof(double))));
  const double* R_AB = X_AB.R.data();
  Four r0, r1;
  std::memcpy(&r0, R_AB, sizeof(Four));
  std::memcpy(&r1, R_AB + 3, sizeof(Four));
  const Four r2{R_AB[6], R_AB[7], R_AB[8], 0};
  const auto rotate = [&](const double* v_B, Four* v_A) {
    *v_A = r0 * v_B[0] + r1 * v_B[1] + r2 * v_B[2];
  };
  Four x, y, z, p;
  rotate(X_BC.R.data(), &x);
  rotate(X_BC.R.data() + 3, &y);
  rotate(X_BC.R.data() + 6, &z);
  rotate(X_BC.p.data(), &p);
  Pose X_AC;
  double* R_AC = X_AC.R.data();
  std::memcpy(R_AC, &x, sizeof(Four));
  std::memcpy(R_AC + 3, &y, sizeof(Four));
  for (int i = 0; i < 3; ++i) {
    R_AC[6 + i] = z[i];
    X_AC.p[i] = p[i] + X_AB.p[i];
  }
  return X_AC;
}

/// Returns the position p_AQ_A of the point with position p_BQ_B.
Eigen::Vector3d operator*(const Pose& X_AB,
                          const Eigen::Vector3d& p_BQ_B) noexcept;

}  // namespace poise
