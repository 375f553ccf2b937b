// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/pose.h"

namespace poise {

Pose Pose::Inverse() const noexcept {
  return {R.transpose(), -(R.transpose() * p)};
}

Eigen::Vector3d operator*(const Pose& X_AB,
                          const Eigen::Vector3d& p_BQ_B) noexcept {
  return X_AB.R * p_BQ_B + X_AB.p;
}

}  // namespace poise
