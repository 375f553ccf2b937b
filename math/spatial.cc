// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/spatial.h"

#include "poise/math/so3.h"

namespace poise {

Matrix6d CrossMatrix(const SpatialMotion& V) noexcept {
  const Eigen::Matrix3d W = Hat(V.angular);
  Matrix6d ad;
  ad << W, Eigen::Matrix3d::Zero(), Hat(V.linear), W;
  return ad;
}

}  // namespace poise
