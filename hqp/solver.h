// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// The fast solver: active-set methods on one factorisation of all levels. Each
/// solve follows a path from the last optimum. A primal method is used if there
/// is no last optimum, or if the path is given up (hqp/fast/search.md). If that
/// answer is not certified, the levels are solved one after the other. See
/// docs/hqp.md and hqp/fast/README.md.
class Solver {
 public:
  /// Allocates memory for all levels at their capacity, and for speed in
  /// problems of many dense inequalities.
  Solver(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Allocates less memory.
  /// @param max_leading_rows  largest number of rows of all levels together,
  ///     without the last levels that have no inequalities and whose rows have
  ///     one variable each. Solve() returns kBadInput if there are more. This
  ///     number determines the memory, about 24 n bytes a row. The capacity of
  ///     each level costs little.
  Solver(int num_variables, const std::vector<LevelCapacity>& capacity,
         int max_leading_rows);
  Solver(Solver&& other) noexcept;
  Solver& operator=(Solver&& other) noexcept;
  ~Solver();

  /// Solves the hierarchy. Does not allocate or throw. The time is that of one
  /// factorisation, and of one update for each change of the working set. Where
  /// an update is not accurate, the levels are factored again.
  ///
  /// Returns kOptimal if solution->certificate is at most 1e-9. Returns
  /// kNotFinite or kBadInput if the hierarchy is invalid or exceeds the
  /// capacity. Else returns kIterationLimit, and failed_level is the first
  /// level that is not certified.
  [[nodiscard]] Status Solve(const Hierarchy& hierarchy,
                             Solution* solution) noexcept;

  /// Forgets the last solve. The next solve is cold: it starts from y = 0 and
  /// the working set of the rows with lower = upper.
  void Forget() noexcept;

  /// Modelled time of the last solve [s], whether or not it was limited. It
  /// covers the answer as well, so that it can exceed max_modelled_seconds.
  double modelled_seconds() const noexcept { return modelled_seconds_; }

  /// Largest number of iterations in the search of one solve. Each factors the
  /// levels or updates them; the first may factor them several times.
  /// Solution::iterations is the number used. Up to three more factorisations
  /// start a search anew or write its answer. If the search did not finish, the
  /// levels above failed_level are optimal, and y is the best of the points
  /// that the search compares when it ends (docs/limits.md). With a limit of 1,
  /// solves of one hierarchy may stay at the same y.
  int max_iterations = 500;

  /// Whether to find LevelSolution::nullity, which takes another factorisation
  /// if an inequality is at its bound. Else it is -1.
  bool finds_nullity = true;

  /// Limit of the modelled time of the search [s]; 0: no limit. Each iteration
  /// has the time that was measured for it on the reference machine, so that a
  /// replay is exact (hqp/fast/budget.h). A limit of time, even a large one,
  /// changes the order of the search: the last of the levels that have
  /// inequalities or rows of several variables is searched after the others.
  /// Each solve makes two iterations and writes its answer, also if that takes
  /// longer.
  double max_modelled_seconds = 0;

  /// Time limit [s], measured by now(). 0, or no now(): no limit. A time limit
  /// makes a replay inexact; a limit of iterations does not. It changes the
  /// order of the search, and allows two iterations, as max_modelled_seconds
  /// does.
  double max_seconds = 0;
  /// Returns a time that never decreases [s]. Solve() calls it at each
  /// iteration, so it must not throw.
  std::function<double()> now;

 private:
  class Impl;  ///< Hides hqp/fast.
  std::unique_ptr<Impl> impl_;
  double modelled_seconds_ = 0;
};

}  // namespace poise
