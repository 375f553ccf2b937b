// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "poise/hqp/fast/projected_rows.h"

namespace poise {

/// Solves a lexicographic least-squares problem. With rows r_a of unit length,
/// targets t_a and metrics d_a, each level minimises
///     1/2 sum_a d_a^2 (r_a y - t_a)^2
/// among the optima of the levels before it.
///
/// Gram-Schmidt orthogonalises the rows, R = L Q with Q orthonormal, and
/// repeats a projection where needed. Within a level, the row with the largest
/// weighted remainder is first. A row with a remainder below kRankTolerance
/// depends on the rows before it. Independent rows are met whatever their
/// metric. A level with dependent rows is deficient: reflections among its rows
/// leave as many "effective" rows as its rank. So L, of all effective rows, is
/// lower triangular, and y = Q' z.
///
/// Levels can be removed from the end and added again. Levels before the first
/// deficient one are all met, so their order does not matter: they can be
/// merged into one, to which single rows are added and removed. Nothing
/// allocates after construction.
class LexicographicFactorization {
 public:
  /// @param max_kept_rows  room for projections, see Recall().
  LexicographicFactorization(int num_variables, int max_rows, int max_levels,
                             int max_kept_rows);
  LexicographicFactorization(int num_variables, int max_rows, int max_levels)
      : LexicographicFactorization(num_variables, max_rows, max_levels,
                                   std::min(max_rows, 2 * num_variables)) {}

  /// The key of a row whose projection is not kept, see Recall().
  static constexpr int kNoKey = -1;

  /// Removes `level` and all later levels.
  void Truncate(int level);

  /// Adds a row to the level that is factored next, and returns its number a.
  /// The caller fills row(a) with num_variables numbers, not all zero.
  int AddRow(double target, double metric);
  double* row(int a) { return &work_[static_cast<std::size_t>(a) * stride_]; }

  /// Gives the row a that was added last a key. The row's projection on the
  /// merged levels is then kept under this key, and follows RemoveRow(),
  /// AppendRow() and Merge(). Returns true if it is known, so that the caller
  /// need not fill row(a).
  [[nodiscard]] bool Recall(int a, int key);

  /// Forgets the projections of keys without Recall() since the last call.
  void ForgetUnused() { kept_.KeepUsed(); }

  /// Factors the rows added since the last level; row(a) is overwritten.
  void FactorLevel();

  /// Merges the levels before `level`, none of which may be deficient. The
  /// merged level has the number of the last of them, and the others are empty.
  /// Removes `level` and all later levels.
  void Merge(int level);

  /// Gives the merged level the number `level` - 1, after the rows of `level`
  /// and of later levels have been removed from it.
  void Unmerge(int level) { Renumber(level); }

  /// Removes row a from the last level, which must not be deficient. The last
  /// row gets the number a. If row a was the e-th, this takes rank() - e
  /// rotations.
  void RemoveRow(int a);

  /// Factors one row added to the last level, which must not be deficient.
  /// Returns false, without adding the row, if its independent part is below
  /// kIndependentPart.
  [[nodiscard]] bool AppendRow();

  /// Solves the last level again, after all RemoveRow() and AppendRow().
  void SolveLast() { SolveLevel(levels_.back()); }

  int num_levels() const { return static_cast<int>(levels_.size()); }
  int num_rows() const { return num_rows_; }
  int rank() const { return rank_; }
  int rank(int level) const { return levels_[level].rank_end; }
  int first_row(int level) const { return levels_[level].first_row; }
  int end_row(int level) const { return levels_[level].end_row; }

  /// Returns whether a row of the level depends on others, or on levels above.
  /// Only such a level can have a residual.
  bool is_deficient(int level) const;

  /// Returns whether the part of each row that is independent of the rows
  /// before it is at least kIndependentPart.
  bool is_well_conditioned() const;

  /// Residual r_a y - t_a; exactly 0 if all rows of the level are independent.
  double residual(int a) const { return residual_[a]; }

  /// Refinement of a solution y: computes the correction of Q y, of rank()
  /// entries, from the residuals t_a - r_a y of the rows as given.
  void Correct(const double* residual, double* change);

  /// Replaces the residuals of a deficient level, and removes their rounding
  /// with KeepUnattainableResiduals(). `size` is the magnitude of their terms.
  void SetResiduals(int level, const double* residual, double size);

  /// Weight d_a^2 of row a.
  double weight(int a) const { return metric_[a] * metric_[a]; }

  /// Q is rank x num_variables, with rows `stride` apart, and y = Q' z.
  const double* basis() const { return q_.data(); }
  int stride() const { return stride_; }
  const double* z() const { return z_.data(); }

  /// Computes the first rank(level - 1) entries of the level's gradient in z,
  /// sum_a d_a^2 residual_a (row a of L). Returns the magnitude of its terms,
  /// or 0 if the gradient is zero.
  double Gradient(int level, double* gradient) const;

  /// Computes multipliers nu of the rows of the levels before `level`, by row,
  /// with sum_a nu_a r_a = Q' rhs. Overwrites rhs, of rank(level - 1) entries.
  void SolveDual(int level, double* rhs, double* nu);

  double norm_z() const;

  /// Multiply-adds of all factorisations and updates since construction.
  std::int64_t multiply_adds() const { return multiply_adds_; }

 private:
  struct Level {
    int first_row, end_row, rank_begin, rank_end;
    bool deficient;  ///< rank_end - rank_begin < end_row - first_row.
  };
  void Renumber(int level);
  void Project(int a);
  void ProjectKept(int a);
  void Count(int rows, int columns);
  void TakeOut(int begin, int end, double* x, double* l);
  void PivotRows(Level* level);
  int TakePivot(int* open);
  void Reduce(Level* level);
  void SolveLevel(const Level& level);
  void KeepUnattainableResiduals(double size, const Level& level);
  void Reflect(int e, int rows, double* x) const;

  int n_, stride_, num_rows_ = 0, rank_ = 0;
  std::vector<Level> levels_;
  /// max_rows x stride: rows, then remainders, then the rows of Reduce().
  std::vector<double> work_;
  std::vector<double> l_;          ///< max_rows x stride: rows of L.
  std::vector<double> q_;          ///< n x stride.
  std::vector<double> effective_;  ///< n x stride: effective rows of L.
  std::vector<double> effective_target_, z_;
  std::vector<double> target_, metric_, residual_, rest_, fresh_;
  std::vector<double> reduced_target_;  ///< By row of the level.
  std::vector<int> carrier_;            ///< Row that an effective row replaces.
  std::vector<double> reflection_;      ///< n x max_rows.
  std::vector<double> factor_, scratch_, cosine_, sine_;
  std::vector<bool> chosen_;
  std::vector<int> open_;     ///< Rows that PivotRows() has not finished.
  std::vector<int> nonzero_;  ///< Rows of the level that Reduce() reflects.
  std::int64_t multiply_adds_ = 0;
  ProjectedRows kept_;  ///< Rows with a key, on the merged levels.
  /// By row: key of its projection in kept_, or kNoKey.
  std::vector<int> key_;
  std::vector<bool> is_recalled_;  ///< By row.
};

}  // namespace poise
