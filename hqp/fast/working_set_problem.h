// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "hqp/fast/diagonal_levels.h"
#include "hqp/fast/lexicographic_factorization.h"
#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// A hierarchy with a guess of its active rows taken as equalities of their own
/// levels: solved by one orthogonalisation (LexicographicFactorization), and a few small problems
/// for last levels that select variables (DiagonalLevels). Below the last level
/// there is one more, the norm of y.
class WorkingSetProblem {
 public:
  WorkingSetProblem(int num_variables,
                    const std::vector<LevelCapacity>& capacity);

  /// A row of the head, as it is in the hierarchy.
  struct Row {
    int level, index;
    bool is_inequality;
    double norm;   ///< |row|_2.
    double bound;  ///< -b, or the bound at work.
  };

  /// What a level, or the norm of y, asks of the rows before it.
  struct Multipliers {
    bool any = false;          ///< Whether its gradient is not zero.
    double size = 0;           ///< Of what they are added up from.
    std::vector<double> nu;    ///< By row of the head, for unit length.
    std::vector<double> left;  ///< DiagonalLevels::Dual(): by variable.
  };

  /// Reads a hierarchy's sizes and the norms of its rows, and checks its numbers:
  /// kNotFinite if one is not finite, or a bound infinite on the wrong side;
  /// kBadInput if lower > upper, a weight is negative, or it has more rows or other
  /// variables than there is room for. failed_level is the first such level.
  Status Read(const Hierarchy& hierarchy, int* failed_level);

  /// Takes the first num_levels levels, and no others; of what they leave free,
  /// the y closest to `center`, or to zero.
  void Plan(const Hierarchy& hierarchy, int num_levels,
            const double* center = nullptr);

  /// Solves for rows active on these sides, by level: if not the first time, by
  /// an update of the last factorisation, as far as that is safe. Then its rows
  /// are not in the order of their levels.
  void Solve(const Hierarchy& hierarchy,
             const std::vector<std::vector<Side>>& side) {
    SolveLeading(hierarchy, side);
    SolveDiagonal();
  }

  /// The same in two steps: the rows of the head, and the y that is best for
  /// these and then for the tail.
  void SolveLeading(const Hierarchy& hierarchy,
                    const std::vector<std::vector<Side>>& side);
  void SolveDiagonal() { diagonal_.Solve(leading_, y_.data()); }

  /// In place of the second: of all y that are best for the head, whatever the
  /// tail asks for, the one closest to this.
  void Approach(const std::vector<double>& y);

  /// Improves y, by what the rows as they were given lack, until each is met as
  /// exactly as its own terms allow: orthogonalisation alone gives it to rounding
  /// of the largest numbers in y, and a level may hold none of these.
  void Refine(const Hierarchy& hierarchy) { Refine(hierarchy, true); }

  /// The same of another y that meets the rows, without going on to the optimum
  /// of what they leave free.
  void RefineFrom(const Hierarchy& hierarchy, const std::vector<double>& y);

  /// Takes another y as it is.
  void SetSolution(const Hierarchy& hierarchy, const std::vector<double>& y);

  /// Of a row that y misses, whether it is active or not: the entries of y that may
  /// be what rounding leaves of a zero become zero, where no active row is met
  /// worse by more than a last digit; with others of y, if it takes these.
  /// Returns whether any does.
  bool ZeroRoundingEntries(const Hierarchy& hierarchy, const double* row);

  /// Finds the multipliers of the levels before this one at the last solve; the
  /// norm of y is level num_levels().
  void FindMultipliers(int end);

  /// Improves them, by what is left of the sum that they should bring to zero,
  /// added up from the rows as they were given. Those of a level of the head
  /// are then followed by what its own rows weigh in that sum: d_a^2 (r_a y -
  /// t_a), but for rounding, which is made up for.
  void RefineMultipliers(const Hierarchy& hierarchy);

  /// The multiplier of an inequality row of the head on a level: positive if the
  /// level is held back by it, negative if it is drawn along, 0 if below
  /// tolerance, relative. On its own level that is its violation.
  double Multiplier(int row, int level, Side side, double tolerance) const;

  int num_levels() const { return num_levels_; }
  int num_leading() const { return num_leading_; }  ///< Levels before the tail.
  const LexicographicFactorization& leading() const { return leading_; }
  DiagonalLevels& diagonal() { return diagonal_; }
  const DiagonalLevels& diagonal() const { return diagonal_; }
  const Row& row(int a) const { return rows_[a]; }
  const Multipliers& multipliers(int level) const {
    return multipliers_[level];
  }
  const std::vector<double>& y() const { return y_; }

  /// The largest of y and of what the active rows and the tail ask for, by
  /// variable or for rows of unit length: what rounding of y is relative to, also
  /// where what is asked for leaves nothing of y.
  double Size() const;

  /// |C_i|_1, and the only variable of row i of B in the tail.
  double norm(int level, int i) const { return norm_[level][i]; }
  int selected(int level, int i) const { return selected_[level][i]; }

 private:
  void AddRow(const Row& row, const double* from, double metric);
  void AddInequality(const Hierarchy& hierarchy, int level, int i, Side side);
  void FactorFrom(const Hierarchy& hierarchy,
                  const std::vector<std::vector<Side>>& side, int level);
  bool Update(const Hierarchy& hierarchy,
              const std::vector<std::vector<Side>>& side);
  void AddToSum(const Hierarchy& hierarchy, int a, double factor,
                double* sum) const;
  const double* Original(const Hierarchy& hierarchy, int a) const;
  double ComputeRowResiduals(const Hierarchy& hierarchy);
  bool Fits(const Hierarchy& hierarchy, int level) const;
  bool IsAtTarget(int j) const;
  double RelativeResidual(int a) const;
  double WorstRelativeLevelResidual() const;
  bool IsUneven() const;
  void Refine(const Hierarchy& hierarchy, bool to_minimum);
  void UpdateDeficientResiduals(const Hierarchy& hierarchy);

  int n_;
  int num_levels_ = 0, num_leading_ = 0;
  bool is_factored_ = false;
  std::vector<std::vector<Side>> factored_;  ///< The sides at work in the head.
  LexicographicFactorization leading_;
  DiagonalLevels diagonal_;
  std::vector<Row> rows_;
  std::vector<Multipliers> multipliers_;
  std::vector<double> y_, gradient_, change_, nu_;
  std::vector<double> row_residual_, size_;  ///< By row of the head.
  std::vector<std::vector<double>> norm_, B_norm_;
  std::vector<std::vector<int>> selected_;
};

}  // namespace poise
