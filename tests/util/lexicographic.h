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

/// Adds a row of weight 1 to a level.
void AppendRow(const Eigen::RowVectorXd& row, double target,
               LeastSquares* level);

/// The minimum-norm y that minimises the levels in order of priority.
struct LexicographicOptimum {
  Eigen::VectorXd y;
  std::vector<int> rank;  ///< Rank of all rows up to each level.
  /// Condition number of the worst level. The relative error of y is about its
  /// square times eps.
  double condition = 1;
};

/// Solves the levels by the textbook method, as a reference: a singular value
/// decomposition of each level in the nullspace of the levels before.
LexicographicOptimum SolveLexicographically(
    int num_variables, const std::vector<LeastSquares>& levels);

/// Draws up to 4 levels of up to 6 rows of unit length in up to 9 variables.
/// About one row in three is a combination of earlier rows. The same seed gives
/// the same levels on every platform.
std::vector<LeastSquares> MakeRandomLevels(std::uint64_t seed);

}  // namespace poise
