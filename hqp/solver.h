// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <vector>

#include "hqp/certificate.h"
#include "hqp/fast/active_set_search.h"
#include "hqp/fast/budget.h"
#include "hqp/fast/multipliers.h"
#include "hqp/fast/working_set_problem.h"
#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// The fast solver: one factorisation of all levels for given active rows, and a
/// descent from the last solve's active rows and y to those of this one. What
/// that cannot certify is solved level by level. See docs/hqp.md.
class Solver {
 public:
  Solver(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Does not allocate or throw. The time is that of some factorisations: one,
  /// if the active rows are still right, and one more a change, about.
  ///
  /// kOptimal: the certificate of the answer is at most 1e-9, or else the status
  /// is kIterationLimit, and failed_level the first level that is not certified.
  [[nodiscard]] Status Solve(const Hierarchy& hierarchy,
                             Solution* solution) noexcept;

  /// Forgets the last solve: the next one is cold.
  void Forget() noexcept;

  /// How many factorisations, or updates of one, a solve may take for its search;
  /// Solution::iterations says how many it took. One more may follow, to report on
  /// a search that did not succeed. If they are spent, the levels above
  /// failed_level are at their optimum, and in what these leave free y is the best
  /// that was found for failed_level, not yet its optimum.
  int max_iterations = 500;

  /// The same in seconds by now(), if that is given; it breaks replay.
  double max_seconds = 0;
  std::function<double()> now;

 private:
  void Prepare(const Hierarchy& hierarchy);
  bool SearchAtOnce(const Hierarchy& hierarchy, int limit, Budget* budget);
  void SearchByLevel(const Hierarchy& hierarchy, Budget* budget,
                     Solution* solution);
  void FindMultipliers(const Hierarchy& hierarchy);
  bool AddViolated(const Hierarchy& hierarchy, bool adds);
  bool WriteSolution(const Hierarchy& hierarchy, Solution* solution);

  int n_;
  WorkingSetProblem problem_;
  ActiveSetSearch search_;
  MultiplierWriter writer_;
  Certifier certifier_;
  std::vector<std::vector<Side>> side_, best_side_;
  std::vector<double> value_;
};

}  // namespace poise
