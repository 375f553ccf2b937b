// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/stacked_rows.h"

#include <cmath>

namespace poise {

int AddRow(const LeastSquares& level, int i,
           LexicographicFactorization* stack) {
  const int a = stack->AddRow(level.b[i], std::sqrt(level.weight[i]));
  const Eigen::VectorXd row = level.A.row(i);
  stack->SetRow(a, row.data(), 0, static_cast<int>(row.size()), 1);
  return a;
}

void AddLevel(const LeastSquares& level, LexicographicFactorization* stack) {
  for (int i = 0; i < level.A.rows(); ++i) AddRow(level, i, stack);
  stack->FactorLevel();
}

Eigen::MatrixXd Basis(const LexicographicFactorization& stack, int n) {
  const FixedVariables& variables = stack.variables();
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(stack.rank(), n);
  for (int e = 0; e < stack.rank(); ++e) {
    if (e < variables.size()) {
      Q(e, variables.fixed_variable(e)) = 1;
      continue;
    }
    const double* row =
        stack.free_basis() + (e - variables.size()) * stack.stride();
    for (int c = 0; c < variables.num_free(); ++c) {
      Q(e, variables.variable(c)) = row[c];
    }
  }
  return Q;
}

Eigen::VectorXd Optimum(const LexicographicFactorization& stack, int n) {
  return Basis(stack, n).transpose() *
         Eigen::VectorXd::Map(stack.z(), stack.rank());
}

}  // namespace poise
