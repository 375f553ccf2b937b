// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/stacked_rows.h"

#include <cmath>

namespace poise {

void AddLevel(const LeastSquares& level, LexicographicFactorization* stack) {
  for (int i = 0; i < level.A.rows(); ++i) {
    const int a = stack->AddRow(level.b[i], std::sqrt(level.weight[i]));
    Eigen::VectorXd::Map(stack->row(a), level.A.cols()) = level.A.row(i);
  }
  stack->FactorLevel();
}

Eigen::MatrixXd Basis(const LexicographicFactorization& stack, int n) {
  Eigen::MatrixXd Q(stack.rank(), n);
  for (int i = 0; i < stack.rank(); ++i) {
    Q.row(i) = Eigen::RowVectorXd::Map(stack.basis() + i * stack.stride(), n);
  }
  return Q;
}

Eigen::VectorXd Optimum(const LexicographicFactorization& stack, int n) {
  return Basis(stack, n).transpose() *
         Eigen::VectorXd::Map(stack.z(), stack.rank());
}

}  // namespace poise
