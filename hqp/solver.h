// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <vector>

#include "hqp/active_problem.h"
#include "hqp/budget.h"
#include "hqp/hierarchy.h"
#include "hqp/level_search.h"
#include "hqp/report.h"
#include "hqp/solution.h"

namespace poise {

/// The fast solver: all levels at once, with an active-set method on the dual,
/// and the last solve's active set to start from. See docs/hqp.md.
///
/// A row's price is a sequence: its own violation, then its multiplier on each
/// lower level; what counts is the first that is not zero. From an active set
/// with no negative price, the most violated rows enter, and the prices go
/// towards those of the new equality-constrained optimum until one would turn
/// negative, whose row leaves. What takes long so is solved by LevelSearch.
class Solver {
 public:
  Solver(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Does not allocate or throw. The time is that of some factorisations: one,
  /// if the active set is still right, and one more a change, or several changes
  /// at once.
  [[nodiscard]] Status Solve(const Hierarchy& hierarchy,
                             Solution* solution) noexcept;

  /// Forgets the last active set: the next solve is a cold one.
  void Forget() noexcept;

  /// The factorisations that a solve may take in all. If they are spent, y is
  /// the best found that keeps the levels above failed_level at their optimum,
  /// where what they leave of it is not that of failed_level yet.
  int max_iterations = 250;

  /// The same in seconds by now(), if that is given; it breaks replay.
  double max_seconds = 0;
  std::function<double()> now;

 private:
  struct Violation {
    int level, index;
    Side side;
    double size;
  };
  /// factor eps^order, with eps as small as you like.
  struct Length {
    int order;
    double factor;
  };
  /// What the search knows of an inequality row.
  struct RowState {
    bool is_new = false;
    std::vector<double> price;  ///< By level.
  };

  void Prepare(const Hierarchy& hierarchy);
  bool Search(const Hierarchy& hierarchy, int limit, Budget* budget);
  void SearchByLevel(const Hierarchy& hierarchy, Budget* budget,
                     Solution* solution);
  void FindViolated(const Hierarchy& hierarchy, bool is_refined);
  int EnterViolated();
  int DropWrong();
  int Advance();
  void ForgetNew();

  bool CanLeave(int a) const;
  bool IsWrong(int a) const;
  double Price(int a, int level) const;
  Length LengthTo(int a) const;
  void MovePrices(const Length& length);
  int Drop(int a);
  RowState& state(int a);
  const RowState& state(int a) const;

  int n_;
  ActiveProblem problem_;
  LevelSearch by_level_;
  Reporter reporter_;
  std::vector<std::vector<Side>> side_, best_side_;
  std::vector<std::vector<bool>> is_fixed_;  ///< lower = upper.
  std::vector<std::vector<RowState>> state_;
  std::vector<double> value_;
  std::vector<Violation> violated_;
  Violation champion_;  ///< The most violated of the rows that entered.
  double tolerance_ = 0;
};

}  // namespace poise
