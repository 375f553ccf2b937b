// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "math/so3.h"

#include <Eigen/SVD>
#include <limits>

#include "math/quaternion.h"
#include "math/stumpff.h"

namespace poise {

Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& w) noexcept {
  const Stumpff c = ComputeStumpff(w);
  const double x = w.x(), y = w.y(), z = w.z();
  const double xy = c.c2 * x * y, xz = c.c2 * x * z, yz = c.c2 * y * z;
  Eigen::Matrix3d R;
  R << 1 - c.c2 * (y * y + z * z), xy - c.c1 * z, xz + c.c1 * y, xy + c.c1 * z,
      1 - c.c2 * (x * x + z * z), yz - c.c1 * x, xz - c.c1 * y, yz + c.c1 * x,
      1 - c.c2 * (x * x + y * y);
  return R;
}

Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R) noexcept {
  return LogQuaternion(QuaternionFromMatrix(R));
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
  if (U.determinant() * svd.matrixV().determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

}  // namespace poise
