// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "poise/tests/util/recorded_ticks.h"

namespace poise {

/// A sequence of ticks to solve.
struct BudgetSequence {
  std::string name;
  RecordingConditions conditions;
};

/// Options of the comparison.
struct BudgetOptions {
  double budget_us = 300;  ///< Solver::max_modelled_seconds, us.
  int repeats = 3;         ///< The time of a tick is the fastest of so many.
};

/// The results of a sequence. Times are in us, one of each tick. Index 0 is
/// without the budget, index 1 with the budget.
struct BudgetResult {
  static constexpr int kLevels = 5;

  std::string name;
  int ticks = 0;
  int unsolved = 0;       ///< Ticks that are not optimal without a budget.
  int cut = 0;            ///< Ticks that are not optimal with the budget.
  int longest_cut = 0;    ///< Longest run of them.
  int cut_only_warm = 0;  ///< Ticks of them that a cold solve finishes.
  /// Ticks but the first that lose priority level 1, 2 or 3.
  int lost_leading = 0;
  /// Ticks but the first that lose momentum's level, 4, or one above.
  int lost_momentum = 0;
  std::array<std::vector<double>, 2> modelled, measured;
  /// By priority level, of each tick that is cut off: the excess of the cost
  /// over that without a budget, relative to max(cost, CostFloor()).
  std::array<std::vector<double>, kLevels> excess;
  /// Gaps of each tick without a budget: Certificate::relative_gap, and the
  /// largest gap relative to max(cost, CostFloor()).
  std::vector<double> gap, gap_above_floor;
};

/// Records a sequence without a budget, and solves all ticks warm without and
/// with a budget.
BudgetResult CompareBudget(const BudgetSequence& sequence,
                           const BudgetOptions& options);

/// Prints the results as tables in Markdown.
void PrintTables(std::vector<BudgetResult> results);

}  // namespace poise
