// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/so3_jacobian.h"

#include "poise/math/so3.h"
#include "poise/math/stumpff.h"

namespace poise {

Eigen::Matrix3d LeftJacobianSo3(const Eigen::Vector3d& w) noexcept {
  const Stumpff c = ComputeStumpff(w);
  Eigen::Matrix3d J = c.c3 * w * w.transpose() + c.c2 * Hat(w);
  J.diagonal().array() += c.c1;
  return J;
}

Eigen::Matrix3d RightJacobianSo3(const Eigen::Vector3d& w) noexcept {
  return LeftJacobianSo3(-w);
}

Eigen::Matrix3d InverseLeftJacobianSo3(const Eigen::Vector3d& w) noexcept {
  const InverseStumpff inverse = ComputeInverseStumpff(w);
  Eigen::Matrix3d J = inverse.d * w * w.transpose() - 0.5 * Hat(w);
  J.diagonal().array() += inverse.e;
  return J;
}

Eigen::Matrix3d InverseRightJacobianSo3(const Eigen::Vector3d& w) noexcept {
  return InverseLeftJacobianSo3(-w);
}

}  // namespace poise
