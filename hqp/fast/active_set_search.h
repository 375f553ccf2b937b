// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <vector>

#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/fast/removal_limits.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Finds the optimum of a hierarchy. AllAtOnce() follows a path from the last
/// optimum, see ParametricSearch. A primal active-set method follows if there
/// is no such optimum, or if the path was given up. See README.md.
///
/// Invariant of the primal method: outside the working set, y violates no row
/// by more than rounding, except in a search that goes on from another y. A
/// step goes from y towards the optimum of the working set, and the first
/// blocking constraint is added to the working set. At that optimum, rows
/// strictly inside their bound are removed. If there is none, the row with the
/// most negative multiplier is removed.
class ActiveSetSearch {
 public:
  ActiveSetSearch(int num_variables,
                  const std::vector<LevelCapacity>& capacity);

  /// Searches on all levels at once, from the working set `side`. Returns
  /// whether the optimum was found: `problem` is then solved for it and has all
  /// its multipliers. If not, the budget, or `limit` iterations of it, did not
  /// suffice. The primal method starts from the optimum of this working set, or
  /// from y() if y() violates fewer rows, or is not worse if the search goes
  /// on. Rows violated there are added to the working set, at once or by later
  /// steps.
  bool AllAtOnce(const Hierarchy& hierarchy, int limit, Budget* budget,
                 WorkingSetProblem* problem,
                 std::vector<std::vector<Side>>* side);

  /// Searches level by level from y = 0, as the cascade of the paper does, on
  /// one factorisation of all levels. This is slower than AllAtOnce(), but
  /// levels that are solved stay solved. Rows that are violated at the optimum
  /// of their own level are equalities from then on.
  ///
  /// Returns the number of levels at their optimum. If the budget suffices,
  /// that is all levels and one more, the norm of y. `problem` is then solved
  /// for the working set `side`, but y() is the answer. If a level is not at
  /// its optimum, y() is the best found for it, and `side` keeps the levels
  /// above it optimal.
  int LevelByLevel(const Hierarchy& hierarchy, Budget* budget,
                   WorkingSetProblem* problem,
                   std::vector<std::vector<Side>>* side);

  /// Ends a search that is not complete. If the search has followed a path, the
  /// next AllAtOnce() continues this path, see Resume(). If not, removes the
  /// rows from the working set that y() meets strictly, and the next
  /// AllAtOnce() starts from y(), if y() is not worse than the optimum of its
  /// working set.
  void Stop(const Hierarchy& hierarchy, const WorkingSetProblem& problem,
            std::vector<std::vector<Side>>* side);

  /// Forgets the last optimum: the next AllAtOnce() follows no path from it.
  void ForgetPath() { path_.Forget(); }
  const std::vector<double>& y() const { return y_; }
  void set_y(const std::vector<double>& y) { y_ = y; }
  void Forget() {
    std::fill(y_.begin(), y_.end(), 0);
    goes_on_ = false;
    path_.Forget();
  }

  /// Replaces `side` by the working set of a path that the budget has ended.
  /// The next AllAtOnce() continues this path.
  void Resume(std::vector<std::vector<Side>>* side) const {
    path_.Resume(side);
  }

 private:
  struct Blocking {
    Side side = Side::kNone;  ///< kNone: the row does not block.
    double length = 1;        ///< Part of the step up to its bound.
    /// Slope, or the violation at the end of the step if the row blocks at
    /// once; divided by the sum of absolute entries.
    double excess = 0;
  };

  void RestoreWorkingSet(std::vector<std::vector<Side>>* side) const;
  enum class PathEnd { kOptimum, kBudget, kGivenUp };
  PathEnd FollowPath(const Hierarchy& hierarchy, int limit, Budget* budget,
                     WorkingSetProblem* problem,
                     std::vector<std::vector<Side>>* side);
  bool SearchFromOptimum(const Hierarchy& hierarchy, int limit, Budget* budget,
                         WorkingSetProblem* problem,
                         std::vector<std::vector<Side>>* side);
  bool InitializeAllLevels(const Hierarchy& hierarchy, bool adds_violated,
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
  RowIndex StepToBlockingConstraint(const Hierarchy& hierarchy,
                                    const WorkingSetProblem& problem,
                                    std::vector<std::vector<Side>>* side);
  Blocking FindBlocking(const Hierarchy& hierarchy,
                        const WorkingSetProblem& problem, RowIndex row,
                        Side side, double noise) const;
  void RemoveDependentRow(const Hierarchy& hierarchy, RowIndex added,
                          WorkingSetProblem* problem,
                          std::vector<std::vector<Side>>* side);
  bool IsInside(const Hierarchy& hierarchy, const WorkingSetProblem& problem,
                RowIndex row, Side side, double largest) const;
  bool RemoveConstraints(int level, WorkingSetProblem* problem,
                         std::vector<std::vector<Side>>* side);
  void FreezeViolated(int level, const WorkingSetProblem& problem,
                      const std::vector<std::vector<Side>>& side);

  int n_;
  ParametricSearch path_;
  std::vector<double> y_;
  /// Optimum of the working set with which the last solve began.
  std::vector<double> set_optimum_;
  std::vector<double> step_, value_, slope_;
  RemovalLimits removals_;
  /// Whether the primal method goes on from the y of a search that was stopped,
  /// or of a path that was given up. This y may be strictly inside bounds of
  /// the working set.
  bool goes_on_ = false;
  /// Iterations left that may remove rows together, see RemoveConstraints().
  int num_together_ = 0;
  /// The row removed last, if it was removed alone.
  RowIndex last_removed_;
  std::vector<std::vector<Side>> violated_;  ///< kNone: not violated.
  std::vector<std::vector<Side>>
      completed_;  ///< Working set of the last solved level.
};

}  // namespace poise
