// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "poise/hqp/fast/active_set_search.h"
#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// A path between two hierarchies of the same rows, for tests of
/// ParametricSearch. Follow() and MeetLevelsBeforeLast() expect that nothing is
/// allocated.
class PathBetween {
 public:
  PathBetween(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Finds the optimum of the first hierarchy without a path, and remembers it.
  void Begin(const Hierarchy& hierarchy);

  /// Solves the leading levels of the second hierarchy for the last working
  /// set.
  void Start(const Hierarchy& hierarchy);

  /// Follows the path to the second hierarchy. Returns whether `limit`
  /// iterations suffice, and the path is not given up.
  bool Follow(const Hierarchy& hierarchy, int limit = kEnough);
  /// Follow() without Start().
  /// @param modelled_seconds  limit of time; 0: none.
  bool FollowFromHere(const Hierarchy& hierarchy, int limit = kEnough,
                      double modelled_seconds = 0);

  /// ParametricSearch::MeetLevelsBeforeLast() after ParametricSearch::Begin()
  /// with y(). If it is postponed, ParametricSearch::PauseAtLevelsBeforeLast()
  /// follows at once. Returns whether the levels are met.
  bool MeetLevelsBeforeLast(const Hierarchy& hierarchy, int limit = kEnough);

  Eigen::VectorXd y() const {
    return Eigen::VectorXd::Map(path_.y().data(), n_);
  }
  /// The answer of the last MeetLevelsBeforeLast().
  Eigen::VectorXd answer() const {
    return Eigen::VectorXd::Map(answer_.data(), n_);
  }
  ParametricSearch& path() { return path_; }
  const WorkingSetProblem& problem() const { return problem_; }
  ParametricSearch::Sides& side() { return side_; }
  /// Iterations of the last Follow().
  int iterations() const { return iterations_; }

  static constexpr int kEnough = 1000;  ///< Iterations.

 private:
  void Read(const Hierarchy& hierarchy);

  int n_, iterations_ = 0;
  const std::function<double()> no_clock_;
  WorkingSetProblem problem_;
  ActiveSetSearch search_;
  ParametricSearch path_;
  std::vector<double> answer_;
  ParametricSearch::Sides side_;
};

/// Adds an inequality without bounds to a level of unit rows, so that it is a
/// leading level and not a diagonal one.
void MakeLeading(int level, Hierarchy* hierarchy);

/// Returns an empty working set.
ParametricSearch::Sides NoSides(const std::vector<LevelCapacity>& capacity);

}  // namespace poise
