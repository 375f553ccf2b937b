// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "poise/hqp/aligned_doubles.h"
#include "poise/hqp/fast/fixed_variables.h"
#include "poise/hqp/fast/lexicographic_factorization.h"

namespace poise {

/// The last levels of a hierarchy if each of their rows is one scaled variable:
/// posture, a regulariser of forces, and the norm of y. Level c minimises
/// 1/2 sum_j d_j^2 (y_j - t_j)^2 over its variables, subject to the leading
/// levels, Q y = z, and to the optimum of the diagonal levels before c.
///
/// The first level that has a variable determines it. So levels are not
/// projected one by one. Instead, reflections combine the rows of Q, and
/// eliminate the variables of the last level first:
///     U' Q = [T_tt ... T_t1 T_t0]      (variables of level t, ..., 1, 0)
///            [         T_11 T_10]
///            [              T_00]
/// From the bottom up, each level is then a weighted minimum-norm problem with
/// as many rows as T_cc. These rows are few, however many variables the level
/// has. Variables that the leading levels fix have no column there.
class DiagonalLevels {
 public:
  DiagonalLevels(int num_variables, int max_levels);

  /// Removes all levels.
  void Clear();
  /// Begins the next level. Add() adds its variables.
  void AddLevel() { ++num_levels_; }
  /// Adds weight/2 (y_variable - target)^2 to the last level. Ignored if an
  /// earlier level has the variable.
  void Add(int variable, double weight, double target);
  /// Adds a last level of all other variables, with these targets by variable,
  /// or with target 0 if `targets` is null.
  void Finish(const double* targets);

  /// Largest absolute target of all variables.
  double largest_target() const { return largest_target_; }

  /// Number of levels, including the one that Finish() adds.
  int num_levels() const { return num_levels_; }

  /// Level that determines a variable.
  int level(int variable) const { return level_of_[variable]; }
  /// Target of a variable on that level.
  double target(int variable) const { return target_[variable]; }

  /// Eliminates variables with the rows of the leading levels. Nullity() needs
  /// only this step. Discards the factors.
  void Tie(const LexicographicFactorization& leading);

  /// Tie() for independent rows, `stride` apart, that need not be orthogonal.
  /// Only Nullity() is valid afterwards.
  void TieRows(const double* rows, int stride, int count);

  /// Computes the y that minimises the levels in order, subject to Q y = z. The
  /// first call after Clear(), Tie() or TieRows() factors the levels. Later
  /// calls update the factors if the row space of Q has gained four directions
  /// at most, or has lost or exchanged one. That takes a tenth of the work for
  /// each gain, and a quarter for a loss. Otherwise they factor again.
  void Solve(const LexicographicFactorization& leading, double* y);

  /// Refines y by a correction dy with Q dy = `change`. If `to_minimum`, y + dy
  /// minimises the levels; else dy has minimum weighted norm, level by level.
  /// pre: `leading` is as in the last Solve(). This holds for Dual() as well.
  void Correct(const LexicographicFactorization& leading, const double* change,
               bool to_minimum, double* y);

  /// Computes the multipliers of level c. Its gradient is d_j^2 (y_j - t_j) on
  /// its own variables. The multipliers on the rows of Q, on_leading, cancel
  /// the gradient on the variables of level c and of later levels. `left` is
  /// the rest of the sum on the variables of earlier levels. Returns the
  /// magnitude of the gradient's terms. If the gradient is zero, returns 0 and
  /// writes nothing.
  double Dual(const LexicographicFactorization& leading, int level,
              double* on_leading, double* left);

  /// Returns whether all variables of a level are exactly at their targets.
  bool IsMet(int level, const double* y) const;

  /// Adds the gradient of a level's own variables to `sum`, and subtracts the
  /// rest `left` that Dual() computed.
  void AddGradient(int level, const double* y, const double* left,
                   double* sum) const;

  /// Sets entries of `sum` to zero if they are rounding of the gradient of a
  /// large-weight variable. They would change the small-weight variables.
  void ZeroRounding(int level, const double* y, double* sum) const;

  /// Dimension of the nullspace of the leading levels and the levels up to
  /// `level`.
  int Nullity(int level) const;

  /// Multiply-adds of Tie(), Solve(), Correct() and Dual() since construction,
  /// but for what Solve() and Correct() do with known factors: that is part of
  /// the time of an iteration (budget.h).
  std::int64_t multiply_adds() const { return multiply_adds_; }

 private:
  struct Block {
    int begin, end;          ///< Positions of its free variables.
    int row_begin, row_end;  ///< Rows of its T_cc in U' Q.
    double size;             ///< Magnitude of the gradient's terms.
  };
  double UsualWeight(const FixedVariables& variables) const;
  void Arrange(const FixedVariables& variables);
  void SetScale(int position) {
    scale_[position] = root_[order_[position]];
    inverse_scale_[position] = 1 / scale_[position];
  }
  int num_fixed() const { return n_ - num_free_; }
  /// Index of the first entry of a row of T, and of the Q of its level.
  std::size_t Index(int row) const {
    return static_cast<std::size_t>(row) * stride_;
  }
  double* T(int row) { return t_.data() + Index(row); }
  double* Q(int row) { return q_.data() + Index(row); }
  /// Row of L. It has row + 1 entries at most, because L is lower triangular.
  double* L(int row) {
    return l_.data() + static_cast<std::size_t>(row) * (row + 1) / 2;
  }
  void FindGradient(int position, const double* y);
  /// After Tie(): whether the rows leave the first level's variables no
  /// freedom. The other levels are eliminated from its rows, which are
  /// orthonormal. So T_00 is then an orthogonal matrix.
  bool IsSquare() const {
    const Block& first = blocks_[0];
    return first.row_end - first.row_begin == first.end - first.begin;
  }
  void Separate();
  bool RoundsUsual() const;
  int LargestColumn(int row_begin, int row_end, int begin, int end,
                    double* squared);
  void Reflect(int row_begin, int row_end, int target, int pivot, int begin,
               int end);
  void Count(int rows, int columns);
  void Gather(const double* rows, int stride, int count,
              const FixedVariables& variables);
  void EliminateAll(int end);
  void Factor(const LexicographicFactorization& leading);
  void Start(const LexicographicFactorization& leading, const double* z);
  void Project(const LexicographicFactorization& leading, const double* x,
               double* on_leading);
  void Eliminate(int level, int end);
  void FactorLevel(int level);
  double FactorRow(int level, int row);
  bool UpdateFactors(const LexicographicFactorization& leading);
  bool IsFactoringFaster(const LexicographicFactorization& leading, int added,
                         int removed) const;
  bool HasRowSpaceOf(const LexicographicFactorization& leading);
  bool FindAdded(const LexicographicFactorization& leading, int power);
  bool FindUnit(int p);
  bool FindRemoved(const LexicographicFactorization& leading);
  void FindSumOfT(bool is_reversed);
  bool SubtractProjectionOnT();
  bool SubtractProjectionOnQ(const LexicographicFactorization& leading);
  bool Normalize();
  bool Release(int p);
  void InsertUnit(int first, int added, int column, int end, double* rows);
  bool HasSquareLaterLevels() const;
  bool AppendDirection();
  bool RemoveDirection();
  void RotateFactor(int row, double c, double s);
  void SolveLevel(int level);
  void FindMultipliers(int level);

  int n_, stride_, num_levels_ = 0;
  int num_free_ = 0;                ///< Number of positions.
  int rank_ = 0;                    ///< Rows of Q that fix no variable.
  std::vector<int> level_of_;       ///< By variable; -1: none yet.
  AlignedDoubles weight_, target_;  ///< By variable.
  AlignedDoubles root_;             ///< Root of the weight, by variable.
  double largest_target_ = 0;
  /// Variable by position: the free ones by level, then the fixed ones.
  std::vector<int> order_;
  std::vector<int> group_begin_;  ///< Arrange(): next positions of its groups.
  FixedVariables none_;           ///< No variable is fixed.
  int usual_begin_ = 0;        ///< Level 0: first position of the usual weight.
  int usual_row_end_ = 0;      ///< Earlier rows have only these variables.
  std::vector<Block> blocks_;  ///< By level.
  AlignedDoubles t_;           ///< U' Q, by position, n x stride.
  AlignedDoubles reflection_;  ///< By row of U' Q.
  AlignedDoubles start_, step_, ideal_, scale_;  ///< By position.
  AlignedDoubles inverse_scale_;                 ///< By position.
  AlignedDoubles x_, magnitude_;                 ///< By position.
  AlignedDoubles gradient_;  ///< Gradient on fixed variables, by position.
  AlignedDoubles z_, nu_;    ///< By row of U' Q.
  AlignedDoubles q_, l_;     ///< T_cc/d = L Q, by level; see L().
  AlignedDoubles scratch_, factor_;
  /// By position: a direction by which the row spaces of T and Q differ, or in
  /// Dual() the sum T' nu.
  AlignedDoubles direction_;
  AlignedDoubles probe_;     ///< By row: factors of sums of rows.
  std::vector<int> column_;  ///< By position: Gather() copies this column.
  std::vector<int> pivot_;  ///< By row of a later level: position of its pivot.
  bool is_factored_ = false;  ///< Whether T, L and Q are those of Solve().
  std::int64_t multiply_adds_ = 0;
};

}  // namespace poise
