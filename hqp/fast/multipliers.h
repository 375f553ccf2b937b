// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <utility>
#include <vector>

#include "hqp/fast/lexicographic_factorization.h"
#include "hqp/fast/working_set_problem.h"
#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// Writes what the fast solver found, as a Solution: the multipliers by level
/// and row, none of them negative where a certificate forbids it, and the
/// nullities.
class Reporter {
 public:
  Reporter(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// @param tolerance  below it, relative, a multiplier is zero.
  /// @param problem    solved; its tail is used up by this.
  void Report(const Hierarchy& hierarchy,
              const std::vector<std::vector<Side>>& side, double tolerance,
              ActiveProblem* problem, Solution* solution);

 private:
  void ReportMultipliers(const ActiveProblem& problem, Solution* solution);
  void ReportTailMultipliers(const Hierarchy& hierarchy, int level,
                             const ActiveProblem& problem, Solution* solution);
  std::pair<int, double> FirstHeldBack(const ActiveProblem& problem,
                                       const Solution& solution, int a,
                                       int level, Side side,
                                       double tolerance) const;
  void MakeNonnegative(const Hierarchy& hierarchy, double tolerance,
                       const ActiveProblem& problem, Solution* solution);
  void AddEquation(const Hierarchy& hierarchy, int from, double factor,
                   const ActiveProblem& problem, int to, Solution* solution);
  void AddOwn(const Hierarchy& hierarchy, int level, double factor,
              const ActiveProblem& problem, const Solution& solution,
              Eigen::VectorXd* sum);
  double Weight(const ActiveProblem& problem, const Solution& solution, int a,
                int level) const;
  double Rounding(const ActiveProblem& problem, const Solution& solution,
                  int level, double tolerance) const;
  void ReportNullity(const Hierarchy& hierarchy, ActiveProblem* problem,
                     Solution* solution);
  bool IsViolated(const ActiveProblem::Row& row,
                  const Solution& solution) const;

  int n_;
  RowStack equalities_;
  std::vector<double> left_;
  double norm_y_ = 0;
};

}  // namespace poise
