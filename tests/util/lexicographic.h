// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace poise {

/// The rows of one level: 1/2 sum_a weight_a (A y - b)_a^2.
struct LeastSquares {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::VectorXd weight;
};

/// The shortest y that minimises the levels, one after the other.
struct LexicographicOptimum {
  Eigen::VectorXd y;
  std::vector<int> rank;  ///< Of all rows down to each level.
  /// Of the worst level: y is as exact as its square times eps.
  double condition = 1;
};

/// An oracle by textbook: each level's singular value decomposition in the
/// nullspace of those before.
LexicographicOptimum SolveLexicographically(
    int num_variables, const std::vector<LeastSquares>& levels);

/// Draws up to 4 levels of up to 6 rows of unit length in up to 9 variables; of
/// three rows, about one is a combination of rows before. The same from the same
/// seed everywhere.
std::vector<LeastSquares> MakeRandomLevels(std::uint64_t seed);

}  // namespace poise
