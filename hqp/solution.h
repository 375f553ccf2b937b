// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hqp/hierarchy.h"

namespace poise {

/// How a solve ended.
enum class Status {
  kOptimal,
  kIterationLimit,  ///< Budget spent: y respects the hierarchy, as far as it
                    ///< got.
  kNotFinite,       ///< NaN or infinity in the rows; y is zero.
  kBadInput,  ///< lower > upper, a negative weight, or no room; y is zero.
};

/// Which side of a row lower <= C y <= upper is at work at y.
enum class Side : signed char { kNone = 0, kLower = -1, kUpper = 1 };

/// The multipliers that level k's optimum puts on the rows of a level j < k.
/// Two-sided rows: positive at upper, negative at lower.
struct LevelMultipliers {
  Eigen::VectorXd equality;
  Eigen::VectorXd inequality;
};

/// What became of one level.
struct LevelSolution {
  double cost;                        ///< 1/2 (sum weight r^2 + |slack|^2).
  Eigen::VectorXd equality_residual;  ///< B y + b.
  Eigen::VectorXd slack;              ///< max(lower - C y, C y - upper, 0).
  std::vector<Side> active;           ///< By inequality row.
  int nullity;  ///< Variables less the rank of all equality rows so far.
  std::vector<LevelMultipliers> multipliers;  ///< By level above this one.
};

/// A solve's answer, sized once for a hierarchy's capacity; only the first
/// num_equalities(level) or num_inequalities(level) entries are meaningful.
struct Solution {
  explicit Solution(int num_variables,
                    const std::vector<LevelCapacity>& capacity);

  /// As constructed: y zero, no multipliers.
  void Reset() noexcept;

  Status status;
  int failed_level;  ///< Where status came from; -1 if optimal.
  int iterations;
  Eigen::VectorXd y;
  std::vector<LevelSolution> levels;
};

/// Fills cost, residual and slack of a level at solution->y.
void EvaluateLevel(const Hierarchy& hierarchy, int level,
                   Solution* solution) noexcept;

/// kNotFinite if a number is NaN, or infinite where only a bound may be (and a
/// lower one only to -inf); kBadInput if lower > upper or a weight is negative;
/// else kOptimal. The first level with an error, or -1.
Status CheckInput(const Hierarchy& hierarchy, int* failed_level) noexcept;

}  // namespace poise
