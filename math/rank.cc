// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/rank.h"

#include <Eigen/Householder>
#include <Eigen/Jacobi>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace poise {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

RankRevealing::RankRevealing(int max_rows, int max_cols)
    : qr_(max_cols, max_rows),
      tau_(std::min(max_rows, max_cols)),
      row_order_(max_rows),
      U_(max_rows, std::min(max_rows, max_cols)),
      V_(max_cols, max_cols),
      sigma_(std::min(max_rows, max_cols)),
      work_(std::max(max_rows, max_cols)) {}

void RankRevealing::Compute(const Eigen::Ref<const Eigen::MatrixXd>& A,
                            double scale) noexcept {
  assert(A.rows() <= qr_.cols() && A.cols() <= qr_.rows());
  rows_ = static_cast<int>(A.rows());
  cols_ = static_cast<int>(A.cols());
  size_ = std::min(rows_, cols_);
  rank_ = 0;
  if (!A.allFinite()) {
    sigma_.head(size_).setConstant(kNan);
    V_.topLeftCorner(cols_, cols_).setConstant(kNan);
    threshold_ = kNan;
    return;
  }
  // The scaled matrix has a largest entry of 1, so that no square overflows.
  const double largest = A.lpNorm<Eigen::Infinity>();
  const double unit = largest == 0 ? 1 : largest;
  qr_.topLeftCorner(cols_, rows_) = A.transpose() / unit;
  FactorTransposed();
  Orthogonalize();
  Sort();
  sigma_.head(size_) *= unit;
  const double sigma_max = size_ == 0 ? 0 : sigma_[0];
  threshold_ = kRankTolerance * std::max(sigma_max, scale);
  while (rank_ < size_ && sigma_[rank_] > threshold_) ++rank_;
}

// Computes A' P = Q R, and U_ = R'. The pivot is the row of A with the longest
// remainder.
void RankRevealing::FactorTransposed() noexcept {
  std::iota(row_order_.begin(), row_order_.begin() + rows_, 0);
  auto R = qr_.topLeftCorner(cols_, rows_);
  for (int j = 0; j < size_; ++j) {
    int longest = 0;
    R.bottomRightCorner(cols_ - j, rows_ - j)
        .colwise()
        .squaredNorm()
        .maxCoeff(&longest);
    longest += j;
    R.col(j).swap(R.col(longest));
    std::swap(row_order_[j], row_order_[longest]);
    double beta;
    R.col(j).tail(cols_ - j).makeHouseholderInPlace(tau_[j], beta);
    R.bottomRightCorner(cols_ - j, rows_ - j - 1)
        .applyHouseholderOnTheLeft(R.col(j).tail(cols_ - j - 1), tau_[j],
                                   work_.data());
    R(j, j) = beta;
  }
  auto L = U_.topLeftCorner(rows_, size_);
  L.setZero();
  for (int j = 0; j < size_; ++j) {
    L.col(j).tail(rows_ - j) = R.row(j).tail(rows_ - j).transpose();
  }
}

// Rotates pairs of columns of U_ until all are orthogonal. U_ is then U S with
// permuted rows, and V_ is Q times the rotations.
void RankRevealing::Orthogonalize() noexcept {
  // Finite matrices converge in fewer sweeps; the bound stops NaN.
  constexpr int kMaxSweeps = 60;
  auto L = U_.topLeftCorner(rows_, size_);
  auto V = V_.topLeftCorner(cols_, cols_);
  V.setIdentity();
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < kMaxSweeps; ++sweep) {
    rotated = false;
    for (int p = 0; p < size_; ++p) {
      for (int q = p + 1; q < size_; ++q) {
        const double pp = L.col(p).squaredNorm(), qq = L.col(q).squaredNorm();
        const double pq = L.col(p).dot(L.col(q));
        // The columns are orthogonal up to the rounding of the product.
        if (std::abs(pq) <= rows_ * kEps * std::sqrt(pp) * std::sqrt(qq)) {
          continue;
        }
        rotated = true;
        // t is the tangent of the smaller angle that makes them orthogonal.
        const double z = (qq - pp) / (2 * pq);
        const double t = std::copysign(1, z) / (std::abs(z) + std::hypot(1, z));
        const Eigen::JacobiRotation<double> G(1 / std::hypot(1, t),
                                              t / std::hypot(1, t));
        L.applyOnTheRight(p, q, G);
        V.topRows(size_).applyOnTheRight(p, q, G);
      }
    }
  }
  for (int j = size_ - 1; j >= 0; --j) {
    V.bottomRows(cols_ - j).applyHouseholderOnTheLeft(
        qr_.col(j).segment(j + 1, cols_ - j - 1), tau_[j], work_.data());
  }
}

// Splits U S into U and S, and sorts the singular values in descending order.
void RankRevealing::Sort() noexcept {
  for (int j = 0; j < size_; ++j) {
    sigma_[j] = U_.col(j).head(rows_).norm();
    if (sigma_[j] > 0) U_.col(j).head(rows_) /= sigma_[j];
  }
  for (int j = 0; j < size_; ++j) {
    int largest = 0;
    sigma_.segment(j, size_ - j).maxCoeff(&largest);
    largest += j;
    std::swap(sigma_[j], sigma_[largest]);
    U_.col(j).swap(U_.col(largest));
    V_.col(j).swap(V_.col(largest));
  }
}

double RankRevealing::condition() const noexcept {
  if (std::isnan(threshold_)) return kNan;
  return rank_ == 0 ? 1 : sigma_[0] / sigma_[rank_ - 1];
}

void RankRevealing::Solve(const Eigen::Ref<const Eigen::VectorXd>& b,
                          Eigen::Ref<Eigen::VectorXd> x) const noexcept {
  assert(b.size() == rows_ && x.size() == cols_);
  x.setConstant(std::isnan(threshold_) ? kNan : 0);
  for (int j = 0; j < rank_; ++j) {
    double product = 0;  // u_j' b.
    for (int i = 0; i < rows_; ++i) product += U_(i, j) * b[row_order_[i]];
    x += product / sigma_[j] * V_.col(j).head(cols_);
  }
}

}  // namespace poise
