// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace poise {

/// The one threshold of rank in this project, relative: a singular value that
/// is not above kRankTolerance of the largest counts as zero, and so does a row
/// of which a projection leaves no more than kRankTolerance. That is far above
/// what rounding leaves of a row that depends on others (eps times the number
/// of its entries, 2e-14 for a hundred), and far below any row that a robot not
/// at a singularity gives.
constexpr double kRankTolerance = 1e-11;

/// The singular value decomposition A = U S V', for what it tells of rank: an
/// orthonormal basis of the rows of A and of its nullspace, its condition, and
/// the least-squares solution of A x = b of least norm.
///
/// By Householder QR of A' with column pivoting, then one-sided Jacobi
/// rotations of the triangle: singular values come out to a few eps of
/// themselves where A is a well-conditioned matrix with scaled rows, and of the
/// largest else. About 6 n m min(n, m) flops to begin with, and 6 m min² more a
/// sweep, of which there are 3 to 8.
///
/// Workspaces are of the size told to the constructor; nothing else allocates,
/// nothing throws.
///
/// Source: Drmač and Veselić, "New fast and accurate Jacobi SVD algorithm I",
/// SIMAX 29(4), 2008, without its second QR.
class RankRevealing {
 public:
  RankRevealing(int max_rows, int max_cols);

  /// Decomposes A, of at most the size told to the constructor (asserted),
  /// possibly of no row or no column.
  ///
  /// @param scale  the norm of what A was computed from, where that was larger
  ///               than A (A is a remainder after a projection, say): then the
  ///               threshold is that of a sigma_max of this size. 1 for rows
  ///               that were of unit length.
  ///
  /// If an entry is not finite, all results are NaN and the rank is 0.
  void Compute(const Eigen::Ref<const Eigen::MatrixXd>& A,
               double scale = 0) noexcept;

  /// The number of singular values above threshold().
  int rank() const noexcept { return rank_; }
  /// kRankTolerance max(sigma_max, scale).
  double threshold() const noexcept { return threshold_; }

  /// min(rows, cols) of them, descending.
  Eigen::Ref<const Eigen::VectorXd> singular_values() const noexcept {
    return sigma_.head(size_);
  }

  /// cols x rank, orthonormal: the first right singular vectors.
  Eigen::Ref<const Eigen::MatrixXd> row_space() const noexcept {
    return V_.block(0, 0, cols_, rank_);
  }
  /// cols x (cols - rank), orthonormal: what A takes to zero.
  Eigen::Ref<const Eigen::MatrixXd> nullspace() const noexcept {
    return V_.block(0, rank_, cols_, cols_ - rank_);
  }

  /// sigma_max over the smallest singular value above the threshold: how much
  /// Solve() can enlarge a relative error of b. 1 if the rank is 0, NaN if an
  /// entry of A was not finite.
  double condition() const noexcept;

  /// x of least norm among those of least |A x - b|: V S^+ U' b.
  /// pre: b has as many entries as A had rows, x as many as A had columns.
  void Solve(const Eigen::Ref<const Eigen::VectorXd>& b,
             Eigen::Ref<Eigen::VectorXd> x) const noexcept;

 private:
  void FactorTransposed() noexcept;
  void Orthogonalize() noexcept;
  void Sort() noexcept;

  int rows_ = 0, cols_ = 0;
  int size_ = 0;  // min(rows, cols).
  int rank_ = 0;
  double threshold_ = 0;
  Eigen::MatrixXd qr_;          // cols x rows: Householder vectors and R.
  Eigen::VectorXd tau_;         // Their factors.
  std::vector<int> row_order_;  // Column j of qr_ was this row of A.
  Eigen::MatrixXd U_;           // rows x size; rows in row_order_.
  Eigen::MatrixXd V_;           // cols x cols.
  Eigen::VectorXd sigma_;
  Eigen::VectorXd work_;
};

}  // namespace poise
