// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "hqp/active_problem.h"
#include "hqp/budget.h"
#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// The search for the active rows that cannot go astray: level by level, from a
/// feasible y to a better feasible one, as the paper's cascade does, but on one
/// factorisation of all levels. Slower than Solver's own where many rows become
/// active, and what that falls back on. See docs/hqp.md.
///
/// On each level: towards the optimum of the active rows as far as the others
/// allow; what is in the way becomes active. At the optimum, the row that holds
/// it back most leaves. Rows violated at their own level's optimum are
/// equalities from then on.
class LevelSearch {
 public:
  LevelSearch(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Returns how many levels are at their optimum: all, and one more, the norm
  /// of y, if the budget allows. `problem` is then solved for the active rows
  /// `side`, but y() is the answer: if a level is not at its optimum, it is the
  /// best found that keeps those above it.
  int Search(const Hierarchy& hierarchy, Budget* budget, ActiveProblem* problem,
             std::vector<std::vector<Side>>* side);

  const std::vector<double>& y() const { return y_; }

 private:
  enum class State : char { kFree, kKept };  ///< Kept: an equality.

  void Begin(const Hierarchy& hierarchy, int level,
             std::vector<std::vector<Side>>* side);
  int Advance(const Hierarchy& hierarchy, int levels,
              const ActiveProblem& problem,
              std::vector<std::vector<Side>>* side);
  int Drop(int level, const ActiveProblem& problem,
           std::vector<std::vector<Side>>* side);
  void Keep(int level, const ActiveProblem& problem,
            const std::vector<std::vector<Side>>& side);

  int n_;
  std::vector<double> y_, step_, value_, slope_;
  std::vector<std::vector<State>> state_;
  int zero_steps_ = 0;
};

}  // namespace poise
