// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace poise {

Eigen::VectorXd Eigenvalues(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A,
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues();
}

JacobiSvd::JacobiSvd(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  U = svd.matrixU();
  sigma = svd.singularValues();
  V = svd.matrixV();
}

LeastSquaresSolution::LeastSquaresSolution(const Eigen::MatrixXd& A,
                                           const Eigen::VectorXd& b) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod(A);
  x = cod.solve(b);
  rank = static_cast<int>(cod.rank());
}

}  // namespace poise
