// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/reference/row_space.h"

#include <Eigen/QR>
#include <cmath>

#include "poise/math/rank.h"

namespace poise {

RowSpace MakeRowSpace(const Eigen::MatrixXd& M, RowSpaceMethod method) {
  if (M.rows() == 0 || M.cols() == 0) {
    return {0, Eigen::MatrixXd::Identity(M.cols(), M.cols())};
  }
  const int rows = static_cast<int>(M.rows());
  const int n = static_cast<int>(M.cols());
  if (method == RowSpaceMethod::kSvd) {
    RankRevealing svd(rows, n);
    svd.Compute(M, 1);
    RowSpace space{svd.rank(), Eigen::MatrixXd(n, n)};
    space.V << svd.row_space(), svd.nullspace();
    return space;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(M.transpose());
  const int rank = static_cast<int>(
      (qr.matrixQR().diagonal().array().abs() > kRankTolerance).count());
  return {rank, qr.householderQ()};
}

}  // namespace poise
