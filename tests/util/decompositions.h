// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

/// Eigen's decompositions, as oracles: the textbook's algorithms, and not ours.
/// Each takes seconds to compile, so it is compiled here, once for all tests.
namespace poise {

/// The eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd Eigenvalues(const Eigen::MatrixXd& A);

/// A = U diag(sigma) V', with U and V square and sigma descending.
struct JacobiSvd {
  explicit JacobiSvd(const Eigen::MatrixXd& A);

  Eigen::MatrixXd U;
  Eigen::VectorXd sigma;
  Eigen::MatrixXd V;
};

/// The shortest of all x that make |A x - b| least, by a complete orthogonal
/// decomposition; and the rank that it gave A.
struct LeastSquaresSolution {
  LeastSquaresSolution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

  Eigen::VectorXd x;
  int rank;
};

}  // namespace poise
