// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/fast/lexicographic_factorization.h"

namespace poise {

/// The last levels of a hierarchy if each of their rows is one scaled variable:
/// posture, a regulariser of forces, and the norm of y. Level c minimises
/// 1/2 sum_j d_j^2 (y_j - t_j)^2 over its variables, subject to the leading levels,
/// Q y = z, and to the optimum of the diagonal levels before c.
///
/// A variable is fixed by the first level that has it, so instead of projecting
/// each level, the rows of Q are combined by reflections, eliminating the
/// variables of the last level first:
///     U' Q = [T_tt ... T_t1 T_t0]      (variables of level t, ..., 1, 0)
///            [         T_11 T_10]
///            [              T_00]
/// From the bottom up each level is then a weighted minimum-norm problem in as
/// many rows as T_cc has: few, however many variables it has.
class DiagonalLevels {
 public:
  DiagonalLevels(int num_variables, int max_levels);

  /// No levels.
  void Clear();
  /// The next level; its variables follow.
  void AddLevel() { ++num_levels_; }
  /// Adds weight/2 (y_variable - target)^2 to the level last added. Ignored if a
  /// level before has the variable: it is fixed.
  void Add(int variable, double weight, double target);
  /// Closes it by a level of all other variables, with these targets, by
  /// variable, or with target 0.
  void Finish(const double* targets);

  /// Of all variables.
  double largest_target() const { return largest_target_; }

  /// With Finish()'s.
  int num_levels() const { return num_levels_; }

  /// The level that fixes a variable.
  int level(int variable) const { return level_of_[variable]; }
  /// Target of a variable on that level.
  double target(int variable) const { return target_[variable]; }

  /// Eliminates the leading levels: all that Nullity() needs.
  void Tie(const LexicographicFactorization& leading);

  /// Tie() for independent rows, `stride` apart, that need not be orthogonal,
  /// as far as Nullity() needs it.
  void TieRows(const double* rows, int stride, int count);

  /// The y that minimises the levels, one after the other, where Q y = z.
  void Solve(const LexicographicFactorization& leading, double* y);

  /// Refines y by a correction with Q dy = `change`. If `to_minimum`, it goes to
  /// the minima of the levels; else it is the smallest one that they allow.
  void Correct(const LexicographicFactorization& leading, const double* change,
               bool to_minimum, double* y);

  /// The multipliers of level c, with the gradient
  /// d_j^2 (y_j - t_j) of its own variables, which they cancel:
  /// on_leading, on the rows of Q, such that the sum of both is 0 on its own and
  /// later variables, and, for each variable of an earlier level, what is then
  /// left of the sum. Returns the size of what the gradient is added up from: 0,
  /// and nothing else, if it is zero.
  double Dual(int level, double* on_leading, double* left);

  /// Whether a level's own variables are exactly at their targets.
  bool IsMet(int level, const double* y) const;

  /// sum += the gradient of a level's own variables, less what Dual() left.
  void AddGradient(int level, const double* y, const double* left,
                   double* sum) const;

  /// Sets entries of that sum to zero if they are rounding of the gradient of a
  /// large-weight variable. Small-weight variables would be changed by them.
  void ZeroRounding(int level, const double* y, double* sum) const;

  /// Dimension of the nullspace of the leading levels and levels up to this one.
  int Nullity(int level) const;

 private:
  struct Block {
    int begin, end;          ///< Positions of its variables.
    int row_begin, row_end;  ///< Its rows of U' Q.
    double size;             ///< Of its gradient: see Dual().
  };
  double UsualWeight() const;
  void Separate();
  bool RoundsUsual() const;
  int LargestColumn(int row_begin, int row_end, int begin, int end,
                    double* squared);
  void Reflect(int row_begin, int row_end, int target, int pivot, int begin,
               int end);
  void Gather(const double* rows, int stride, int count);
  void EliminateAll(int end);
  void Start(const LexicographicFactorization& leading, const double* z);
  void Eliminate(int level, int end);
  void FactorLevel(int level);
  void SolveLevel(int level);
  void FindMultipliers(int level);

  int n_, stride_, num_levels_ = 0, rank_ = 0, num_reflections_ = 0;
  std::vector<int> level_of_;            ///< By variable; -1: none yet.
  std::vector<double> weight_, target_;  ///< By variable.
  double largest_target_ = 0;
  std::vector<int> order_;  ///< Variable by position.
  int usual_begin_ =
      0;  ///< Level 0: where variables of its usual weight begin.
  int usual_row_end_ = 0;           ///< Its rows before have none but these.
  std::vector<Block> blocks_;       ///< By level.
  std::vector<double> t_;           ///< U' Q, by position, n x stride.
  std::vector<double> reflection_;  ///< n x stride.
  std::vector<double> start_, step_, ideal_, scale_;  ///< By position.
  std::vector<double> x_, magnitude_;                 ///< By position.
  std::vector<double> z_, nu_;                        ///< By row of U' Q.
  std::vector<double> q_, l_;                         ///< Levels' T/d = L Q.
  std::vector<double> scratch_, factor_;
};

}  // namespace poise
