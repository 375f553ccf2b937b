// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <utility>
#include <vector>

#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Writes the answer of the search as a Solution: y, working set, nullities,
/// and the multipliers by level and row. Inequality multipliers are made
/// nonnegative where the certificate requires that.
class MultiplierWriter {
 public:
  explicit MultiplierWriter(int num_variables);

  /// Writes y, the levels and their multipliers. Where signs are corrected, a
  /// multiplier below tolerances::kZeroMultiplier, relative to the largest one,
  /// counts as zero.
  /// @param problem  the solved problem; its factorisation and its diagonal
  ///                 levels may be overwritten.
  void Write(const Hierarchy& hierarchy,
             const std::vector<std::vector<Side>>& side,
             WorkingSetProblem* problem, Solution* solution);

  bool finds_nullity = true;  ///< Solver::finds_nullity.

 private:
  void WriteMultipliers(const WorkingSetProblem& problem, Solution* solution);
  void WriteDiagonalMultipliers(const Hierarchy& hierarchy, int level,
                                const WorkingSetProblem& problem,
                                Solution* solution);
  std::pair<int, double> FirstPositiveMultiplier(
      const WorkingSetProblem& problem, const Solution& solution, int a,
      int level, Side side) const;
  void MakeNonnegative(const Hierarchy& hierarchy,
                       const WorkingSetProblem& problem, Solution* solution);
  void AddEquation(const Hierarchy& hierarchy, int from, double factor,
                   const WorkingSetProblem& problem, int to,
                   Solution* solution);
  void AddOwnMultipliers(const Hierarchy& hierarchy, int level, double factor,
                         const WorkingSetProblem& problem,
                         const Solution& solution, Eigen::VectorXd* sum);
  double Weight(const WorkingSetProblem& problem, const Solution& solution,
                int a, int level) const;
  double Rounding(const WorkingSetProblem& problem, const Solution& solution,
                  int level) const;
  void WriteNullity(const Hierarchy& hierarchy, WorkingSetProblem* problem,
                    Solution* solution);
  bool IsViolated(const WorkingSetProblem::Row& row,
                  const Solution& solution) const;

  int n_;
  std::vector<double> remainder_;
  double norm_y_ = 0;
};

}  // namespace poise
