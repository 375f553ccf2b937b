// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <vector>

#include "hqp/fast/budget.h"
#include "hqp/fast/working_set_problem.h"
#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// The search for the active rows: from a y that breaks no row but active ones
/// to a better such y, until it is the optimum. See docs/hqp.md.
///
/// Towards the optimum of the active rows as far as the others allow; what is in
/// the way becomes active. At that optimum, rows that nothing holds at their
/// bound leave; if there are none, the row that holds the levels back most.
class ActiveSetSearch {
 public:
  ActiveSetSearch(int num_variables,
                  const std::vector<LevelCapacity>& capacity);

  /// On all levels at once, from the active rows `side`; false if the budget, or
  /// `limit` iterations of it, did not suffice. The start is the optimum of
  /// these rows, or y() if that breaks fewer rows; what is broken there becomes
  /// active.
  bool AllAtOnce(const Hierarchy& hierarchy, int limit, Budget* budget,
                 WorkingSetProblem* problem,
                 std::vector<std::vector<Side>>* side);

  /// Level by level, from y = 0, as the paper's cascade does, but on one
  /// factorisation of all levels: slower, but what is found for a level stays.
  /// Rows violated at their own level's optimum are equalities from then on.
  ///
  /// Returns how many levels are at their optimum: all, and one more, the norm
  /// of y, if the budget allows. `problem` is then solved for the active rows
  /// `side`, but y() is the answer: if a level is not at its optimum, it is the
  /// best found that keeps those above it, and `side` what holds these.
  int LevelByLevel(const Hierarchy& hierarchy, Budget* budget,
                   WorkingSetProblem* problem,
                   std::vector<std::vector<Side>>* side);

  const std::vector<double>& y() const { return y_; }
  void Forget() { std::fill(y_.begin(), y_.end(), 0); }

 private:
  struct RowIndex {
    int level, row;
  };

  void RestoreWorkingSet(std::vector<std::vector<Side>>* side) const;
  bool InitializeAllLevels(const Hierarchy& hierarchy,
                           WorkingSetProblem* problem,
                           std::vector<std::vector<Side>>* side);
  int FindViolated(const Hierarchy& hierarchy, const WorkingSetProblem& problem,
                   const std::vector<double>& y,
                   const std::vector<std::vector<Side>>& side);
  void InitializeWorkingSet(const Hierarchy& hierarchy, int level,
                            std::vector<std::vector<Side>>* side);
  bool Iterate(const Hierarchy& hierarchy, int level,
               WorkingSetProblem* problem,
               std::vector<std::vector<Side>>* side);
  bool StepToBlockingConstraint(const Hierarchy& hierarchy,
                                const WorkingSetProblem& problem,
                                std::vector<std::vector<Side>>* side);
  bool RemoveConstraints(int level, WorkingSetProblem* problem,
                         std::vector<std::vector<Side>>* side);
  void FreezeViolated(int level, const WorkingSetProblem& problem,
                      const std::vector<std::vector<Side>>& side);

  int n_;
  std::vector<double> y_, step_, value_, slope_;
  std::vector<std::vector<int>>
      removals_left_;  ///< How often it still may leave.
  bool remove_together_ =
      false;  ///< Whether rows may leave for the tail at once.
  RowIndex last_removed_ = {-1,
                            -1};  ///< The row that left last, if it did alone.
  std::vector<std::vector<Side>> violated_;   ///< kNone: not broken.
  std::vector<std::vector<Side>> completed_;  ///< When the last level was done.
};

}  // namespace poise
