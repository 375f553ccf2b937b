// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/row_space.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

namespace poise {

RowSpace MakeRowSpace(const Eigen::MatrixXd& M, RowSpaceMethod method) {
  if (M.rows() == 0 || M.cols() == 0) {
    return {0, Eigen::MatrixXd::Identity(M.cols(), M.cols())};
  }
  if (method == RowSpaceMethod::kSvd) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeFullV);
    const int rank = static_cast<int>(
        (svd.singularValues().array() > kRankTolerance).count());
    return {rank, svd.matrixV()};
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(M.transpose());
  const int rank = static_cast<int>(
      (qr.matrixQR().diagonal().array().abs() > kRankTolerance).count());
  return {rank, qr.householderQ()};
}

}  // namespace poise
