// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

namespace poise {

/// The lexicographic least-squares solution of levels of rows: with rows r_a of
/// unit length, targets t_a and metrics d_a, each level minimises
///     1/2 sum_a d_a^2 (r_a y - t_a)^2
/// among the optima of the levels before it.
///
/// Gram-Schmidt orthogonalises the rows, twice where needed, in a level the
/// largest weighted remainder first: R = L Q, with Q orthonormal. A row with a
/// remainder below kRankTolerance depends on the rows before it. Independent rows
/// are met whatever their metric. In a deficient level, one with dependent rows,
/// reflections among its rows leave as many "effective" rows as its rank. So L, of
/// all effective rows, is lower triangular, and y = Q' z.
///
/// Levels can be removed from the end and added again. Levels before the first
/// deficient one are all met, so their order does not matter: they can be merged
/// into one, to which single rows are added and removed. Nothing allocates after
/// construction.
class LexicographicFactorization {
 public:
  LexicographicFactorization(int num_variables, int max_rows, int max_levels);

  /// Drops the levels from this one on.
  void Truncate(int level);

  /// A new row of the level about to be factored: to be filled with
  /// num_variables numbers, not all zero. Returns its number, a.
  int AddRow(double target, double metric);
  double* row(int a) { return &work_[static_cast<std::size_t>(a) * stride_]; }

  /// Factors the rows added since the last level; row(a) is overwritten.
  void FactorLevel();

  /// Makes one level of those before `level`, none of them deficient: it takes
  /// the number of the last one, the others are empty. Drops the levels from
  /// this one on.
  void Merge(int level);

  /// Takes row a out of the last level, which is not deficient; the last row gets
  /// its number. Takes rank() - e rotations, where it was the e-th.
  void RemoveRow(int a);

  /// Factors one row added to the last level, which is not deficient. False if
  /// no good part of it is independent: then it is not in it.
  [[nodiscard]] bool AppendRow();

  /// Solves the last level anew: after all RemoveRow() and AppendRow().
  void SolveLast() { SolveLevel(levels_.back()); }

  int num_levels() const { return static_cast<int>(levels_.size()); }
  int num_rows() const { return num_rows_; }
  int rank() const { return rank_; }
  int rank(int level) const { return levels_[level].rank_end; }
  int first_row(int level) const { return levels_[level].first_row; }
  int end_row(int level) const { return levels_[level].end_row; }

  /// Whether some row of the level depends on others, or on levels above: only
  /// then its residual need not be zero.
  bool is_deficient(int level) const;

  /// Whether all rows are independent, and none nearly not: each has a good part
  /// that those before it have not.
  bool is_well_conditioned() const;

  /// r_a y - t_a; exactly 0 where all rows of the level are independent.
  double residual(int a) const { return residual_[a]; }

  /// Refinement of a solution y: computes the correction of Q y, of rank()
  /// entries, from the residuals t_a - r_a y of the rows as given.
  void Correct(const double* residual, double* change);

  /// Takes other residuals of a deficient level, added up from numbers of a size,
  /// as far as its optimum has them: see KeepUnattainableResiduals().
  void SetResiduals(int level, const double* residual, double size);

  /// d_a^2.
  double weight(int a) const { return metric_[a] * metric_[a]; }

  /// Q, rank x num_variables, its rows `stride` apart; and y = Q' z.
  const double* basis() const { return q_.data(); }
  int stride() const { return stride_; }
  const double* z() const { return z_.data(); }

  /// The level's gradient in z, sum_a d_a^2 residual_a (row a of L), its first
  /// rank(level - 1) entries. Returns the size of what it is added up from: 0,
  /// and nothing else, if it is zero.
  double Gradient(int level, double* gradient) const;

  /// The multipliers nu, by row, that rows of the levels < level need for
  /// sum_a nu_a r_a = Q' rhs. rhs, of rank(level - 1) entries, is overwritten.
  void SolveDual(int level, double* rhs, double* nu);

  double norm_z() const;

 private:
  struct Level {
    int first_row, end_row, rank_begin, rank_end;
    bool deficient;  ///< rank_end - rank_begin < end_row - first_row.
  };
  void Project(int a);
  void TakeOut(int rank, double* x, double* l);
  void PivotRows(Level* level);
  void Reduce(Level* level);
  void SolveLevel(const Level& level);
  void KeepUnattainableResiduals(double size, const Level& level);
  void Reflect(int e, int rows, double* x) const;

  int n_, stride_, num_rows_ = 0, rank_ = 0;
  std::vector<Level> levels_;
  std::vector<double> work_;     ///< max_rows x stride: rows, then their rests.
  std::vector<double> l_;        ///< max_rows x stride: rows of L.
  std::vector<double> reduced_;  ///< max_rows x stride: one level's, reduced.
  std::vector<double> q_;        ///< n x stride.
  std::vector<double> effective_;  ///< n x stride: effective rows of L.
  std::vector<double> effective_target_, z_;
  std::vector<double> target_, metric_, residual_, rest_, fresh_;
  std::vector<int> carrier_;  ///< Effective row: the row it is, or replaces.
  std::vector<double> reflection_;  ///< n x max_rows.
  std::vector<double> factor_, scratch_, cosine_, sine_;
  std::vector<bool> chosen_;
};

}  // namespace poise
