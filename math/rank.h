// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// kRankTolerance is the only rank threshold of this project, and relative. A
/// singular value counts as zero if it is at most kRankTolerance times the
/// largest one. A row of unit length counts as dependent if a projection leaves
/// a remainder of at most this length. Rounding of a dependent row leaves eps
/// times the number of its entries, 2e-14 for a hundred, which is far below the
/// threshold. Rows of a robot that is not at a singularity are far above it.
constexpr double kRankTolerance = 1e-11;

/// RankRevealing computes the singular value decomposition A = U S V', and from
/// it the rank, orthonormal bases of the row space and the nullspace, the
/// condition, and the least-squares solution of A x = b of least norm.
///
/// The algorithm is Householder QR of A' with column pivoting, then one-sided
/// Jacobi rotations of the triangle. If A is a well-conditioned matrix with
/// scaled rows, each singular value has a relative error of a few eps;
/// otherwise the error is relative to the largest one. The QR costs about 6 n m
/// min(n, m) flops, and each of 3 to 8 sweeps 6 m min(n, m)² flops.
///
/// The constructor allocates all workspaces; nothing else allocates, nothing
/// throws.
///
/// Source: Drmač and Veselić, "New fast and accurate Jacobi SVD algorithm I",
/// SIMAX 29(4), 2008, without its second QR.
class RankRevealing {
 public:
  RankRevealing(int max_rows, int max_cols);

  /// Decomposes A, which has at most the constructor's size (asserted). A may
  /// have no rows or no columns.
  ///
  /// @param scale  norm of the matrix that A was computed from, if A is a
  ///               remainder after a projection. The threshold is then relative
  ///               to scale if scale exceeds sigma_max. Use 1 for rows that had
  ///               unit length.
  ///
  /// If an entry is not finite, all results are NaN and the rank is 0.
  void Compute(const Eigen::Ref<const Eigen::MatrixXd>& A,
               double scale = 0) noexcept;

  /// Returns the number of singular values above threshold().
  int rank() const noexcept { return rank_; }
  /// Returns kRankTolerance max(sigma_max, scale).
  double threshold() const noexcept { return threshold_; }

  /// Returns the min(rows, cols) singular values in descending order.
  Eigen::Ref<const Eigen::VectorXd> singular_values() const noexcept {
    return sigma_.head(size_);
  }

  /// Returns an orthonormal basis of the row space, cols x rank: the first
  /// right singular vectors.
  Eigen::Ref<const Eigen::MatrixXd> row_space() const noexcept {
    return V_.block(0, 0, cols_, rank_);
  }
  /// Returns an orthonormal basis of the nullspace, cols x (cols - rank).
  Eigen::Ref<const Eigen::MatrixXd> nullspace() const noexcept {
    return V_.block(0, rank_, cols_, cols_ - rank_);
  }

  /// Returns sigma_max divided by the smallest singular value above the
  /// threshold. Solve() can enlarge a relative error of b by this factor. The
  /// condition is 1 if the rank is 0, and NaN if an entry of A is not finite.
  double condition() const noexcept;

  /// Computes the x of least norm that minimises |A x - b|: V S^+ U' b.
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
