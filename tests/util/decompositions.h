// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

/// Eigen's decompositions of matrices, as references for tests that are
/// independent of Poise's own. Each takes seconds to compile, so all tests
/// share this library.
namespace poise {

/// Returns the eigenvalues of a symmetric matrix in ascending order.
Eigen::VectorXd Eigenvalues(const Eigen::MatrixXd& A);

/// A = U diag(sigma) V', with U and V square and sigma descending.
struct JacobiSvd {
  explicit JacobiSvd(const Eigen::MatrixXd& A);

  Eigen::MatrixXd U;
  Eigen::VectorXd sigma;
  Eigen::MatrixXd V;
};

/// The x of minimum norm that minimises |A x - b|, by a complete orthogonal
/// decomposition, and the rank of A that it finds.
struct LeastSquaresSolution {
  LeastSquaresSolution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

  Eigen::VectorXd x;
  int rank;
};

}  // namespace poise
