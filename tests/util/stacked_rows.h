// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/tests/util/lexicographic.h"

namespace poise {

/// Adds row i of a level to a stack, and returns its number there.
int AddRow(const LeastSquares& level, int i, LexicographicFactorization* stack);

/// Adds the rows of a level to a stack and factors them.
void AddLevel(const LeastSquares& level, LexicographicFactorization* stack);

/// Returns the stack's basis Q, rank x n.
Eigen::MatrixXd Basis(const LexicographicFactorization& stack, int n);

/// Returns the stack's y = Q' z.
Eigen::VectorXd Optimum(const LexicographicFactorization& stack, int n);

}  // namespace poise
