// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/so3.h"

#include <Eigen/SVD>
#include <limits>

#include "poise/math/quaternion.h"

namespace poise {

Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R) noexcept {
  return LogQuaternion(Eigen::Quaterniond(R));
}

Eigen::Matrix3d InterpolateSo3(const Eigen::Matrix3d& R_0,
                               const Eigen::Matrix3d& R_1, double t) noexcept {
  return R_0 * ExpSo3(t * LogSo3(R_0.transpose() * R_1));
}

Eigen::Matrix3d ProjectToSo3(const Eigen::Matrix3d& A) noexcept {
  if (!A.allFinite()) {
    return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  const Eigen::Matrix3d V = svd.matrixV();
  if ((U * V.transpose()).determinant() < 0) U.col(2) = -U.col(2);
  return U * V.transpose();
}

}  // namespace poise
