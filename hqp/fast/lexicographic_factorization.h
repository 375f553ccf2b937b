// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "poise/hqp/aligned_doubles.h"
#include "poise/hqp/fast/fixed_variables.h"
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
/// merged into one, to which single rows are added and removed. There, the rows
/// of one variable come first. Such a row is one of Q, up to its sign, and all
/// other rows of Q are zero in its column: the variable is fixed, and the
/// arithmetic is that of the free variables only. Nothing allocates after
/// construction.
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

  /// Removes `level` and all later levels. If the merged level is removed, all
  /// variables become free.
  void Truncate(int level);

  /// Adds a row to the level that is factored next, and returns its number a.
  /// The caller fills row(a) with num_variables numbers, not all zero, in the
  /// order of variables().column(), or calls SetRow().
  int AddRow(double target, double metric);
  double* row(int a) {
    return work_.data() + static_cast<std::size_t>(a) * stride_;
  }

  /// Fills row(a) with from[j] / norm, for `first` <= j < `end`.
  void SetRow(int a, const double* from, int first, int end, double norm);

  /// Adds the row entry * y_variable, with entry = 1 or -1, to the merged level
  /// that FactorMerged() factors next, and returns its number. The variable
  /// must be free. pre: there are only such rows.
  int AddFixedVariable(int variable, double entry, double target,
                       double metric);

  /// Gives the row a that was added last a key. The row's projection on the
  /// merged levels is then kept under this key, and follows RemoveRow(),
  /// AppendRow() and Merge(). Returns true if it is known, so that the caller
  /// need not fill row(a). Also returns false if the levels before determine y,
  /// because the row is then not projected.
  [[nodiscard]] bool Recall(int a, int key);

  /// Forgets the projections of keys without Recall() since the last call.
  void ForgetUnused() { kept_.KeepUsed(); }

  /// Factors the rows added since the last level; row(a) is overwritten. If
  /// multiply_adds() exceeds set_max_multiply_adds() before the end, this
  /// function removes the rows and adds no level.
  void FactorLevel();
  /// Limits multiply_adds() of FactorLevel() and FactorMerged(). They exceed it
  /// by the projection of the rows, and by one row of Q or one reflection, at
  /// most.
  void set_max_multiply_adds(std::int64_t most) { max_multiply_adds_ = most; }

  /// Merges the levels before `level`, none of which may be deficient. The
  /// merged level has the number of the last of them, and the others are empty.
  /// Removes `level` and all later levels.
  void Merge(int level);

  /// Factors all rows, those of AddFixedVariable() and of AddRow(), as the
  /// levels before `level`, merged. Returns false and removes all rows if the
  /// independent part of one is below kIndependentPart, or if multiply_adds()
  /// exceeds its limit before the last row. pre: no level has been factored.
  [[nodiscard]] bool FactorMerged(int level);

  /// Gives the merged level the number `level` - 1, after the rows of `level`
  /// and of later levels have been removed from it.
  void Unmerge(int level) { Renumber(level); }

  /// Removes row a from the last level, which must not be deficient. The last
  /// row gets the number a. If row a was the e-th, this takes rank() - e
  /// rotations. If it fixed a variable, this takes one for each row that fixes
  /// none, and the variable becomes free.
  void RemoveRow(int a);

  /// Factors one row added to the last level, which must not be deficient.
  /// Returns false, without adding the row, if its independent part is below
  /// kIndependentPart.
  [[nodiscard]] bool AppendRow();

  /// AppendRow() for the row entry * y_variable, with entry = 1 or -1. Fixes
  /// the variable, with one rotation for each row that fixes none.
  [[nodiscard]] bool AppendFixedVariable(int variable, double entry);

  /// Solves the last level again, after all RemoveRow() and AppendRow().
  void SolveLast() { SolveLevel(levels_.back()); }
  /// Changes the target of a row. Call SolveFrom() or SolveLast() after the
  /// last change.
  void SetTarget(int a, double target) { target_[a] = target; }
  /// Solves the levels from `level` on again.
  void SolveFrom(int level) {
    for (int k = level; k < num_levels(); ++k) SolveLevel(levels_[k]);
  }

  int num_levels() const { return static_cast<int>(levels_.size()); }
  /// Number of levels that are merged. All but the last of them are empty.
  int num_merged() const { return num_merged_; }
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
  void Correct(const double* residual, double* change) {
    Correct(residual, num_levels(), change);
  }
  /// Correct() for the first num_levels levels, of rank(num_levels - 1)
  /// entries.
  void Correct(const double* residual, int num_levels, double* change);

  /// Replaces the residuals of a deficient level, and removes their rounding
  /// with KeepUnattainableResiduals(). `size` is the magnitude of their terms.
  void SetResiduals(int level, const double* residual, double size);

  /// Weight d_a^2 of row a.
  double weight(int a) const { return metric_[a] * metric_[a]; }

  /// The order of the columns of Q. Rows of Q before variables().size() are
  /// unit vectors: row e has a one in column variables().fixed_column(e).
  const FixedVariables& variables() const { return variables_; }
  /// The other rows of Q. Each has variables().num_free() entries and is zero
  /// in the other columns, which are not stored. Rows lie `stride` apart; y =
  /// Q' z.
  const double* free_basis() const { return q(variables_.size()); }
  int stride() const { return stride_; }
  const double* z() const { return z_.data(); }

  /// Computes the first `rank` entries of Q y.
  void Project(const double* y, int rank, double* on_basis);

  /// y += Q' z, with the first `rank` rows of Q.
  void AddCombination(const double* z, int rank, double* y);

  /// Computes the first rank(level - 1) entries of the level's gradient in z,
  /// sum_a d_a^2 residual_a Q r_a'. Returns the magnitude of its terms,
  /// or 0 if the gradient is zero.
  double Gradient(int level, double* gradient);

  /// Computes multipliers nu of the rows of the levels before `level`, by row,
  /// with sum_a nu_a r_a = Q' rhs. Overwrites rhs, of rank(level - 1) entries.
  void SolveDual(int level, double* rhs, double* nu);

  double norm_z() const;

  /// Multiply-adds of factorisations, updates, substitutions and products with
  /// Q since construction, and kernels::kRowOverhead more for each row.
  std::int64_t multiply_adds() const { return multiply_adds_; }

 private:
  struct Level {
    int first_row, end_row, rank_begin, rank_end;
    bool deficient;  ///< rank_end - rank_begin < end_row - first_row.
    bool has_effective_rows() const { return rank_begin < rank_end; }
  };
  const double* q(int e) const {
    return q_.data() + static_cast<std::size_t>(e) * stride_;
  }
  double* q(int e) { return q_.data() + static_cast<std::size_t>(e) * stride_; }
  double* l_row(int a) {
    return l_.data() + static_cast<std::size_t>(a) * stride_;
  }
  double* effective(int e) {
    return effective_.data() + static_cast<std::size_t>(e) * stride_;
  }
  /// The vector v of column e: H = I - v v', over the rows of its level.
  const double* reflection(int e) const {
    return reflection_.data() +
           static_cast<std::size_t>(e) * (reflection_.size() / n_);
  }
  double* reflection(int e) {
    return reflection_.data() +
           static_cast<std::size_t>(e) * (reflection_.size() / n_);
  }
  void Renumber(int level);
  /// Returns whether the levels before determine y. The level then has no rows
  /// of L: its residuals are computed from y, and its gradient from the rows as
  /// they were set.
  bool IsDetermined(const Level& level) const { return level.rank_begin == n_; }
  bool IsLate() const { return multiply_adds_ > max_multiply_adds_; }
  void FactorRows(Level* level);
  void ProjectColumns(const double* y, int rank, double* on_basis);
  void CombineColumns(const double* z, int rank, double* y);
  void CopyEffective(const Level& level);
  int Release(int e);
  void FixLast(int variable, double entry);
  void ProjectRow(int a);
  void ProjectKept(int a);
  void TakeOutFixed(double* x, double* l);
  void Count(int rows, int columns);
  void TakeOut(int begin, int end, double* x, double* l);
  void PivotRows(Level* level);
  int TakePivot(int* open);
  void Reduce(Level* level);
  int ReduceColumn(const Level& level, int e, int count);
  void SolveLevel(const Level& level);
  void FindResiduals(const Level& level);
  void CountTriangle(const Level& level, int begin);
  void SolveRows(const Level& level, const double* target, double* z);
  void KeepUnattainableResiduals(double size, const Level& level);
  void Reflect(int e, int rows, double* x) const;

  int n_, stride_, num_rows_ = 0, rank_ = 0, num_merged_ = 0;
  FixedVariables variables_;
  std::vector<Level> levels_;
  /// max_rows x stride: rows, then remainders, then the rows of Reduce(). Rows
  /// of a level that is determined stay.
  AlignedDoubles work_;
  AlignedDoubles l_;  ///< max_rows x stride: rows of L.
  AlignedDoubles q_;  ///< n x stride; see variables().
  /// n x stride: effective rows of L. Those of a deficient level hold its own
  /// columns only.
  AlignedDoubles effective_;
  AlignedDoubles z_;
  AlignedDoubles target_, metric_, residual_, rest_, fresh_;
  std::vector<int> carrier_;   ///< Row that an effective row replaces.
  AlignedDoubles reflection_;  ///< n x max_rows.
  AlignedDoubles factor_, scratch_, packed_;
  std::vector<bool> is_pivot_;  ///< By row, in Reduce().
  /// PivotRows(): rows that are neither orthogonalised nor zero. Reduce():
  /// numbers in the level of the rows that may contain its column.
  std::vector<int> open_;
  std::vector<int>
      nonzero_;  ///< ReduceColumn(): those of them that contain it.
  std::int64_t multiply_adds_ = 0;
  std::int64_t max_multiply_adds_ = std::numeric_limits<std::int64_t>::max();
  ProjectedRows kept_;  ///< Rows with a key, on the merged levels.
  /// By row: key of its projection in kept_, or kNoKey.
  std::vector<int> key_;
  std::vector<bool> is_recalled_;  ///< By row.
};

}  // namespace poise
