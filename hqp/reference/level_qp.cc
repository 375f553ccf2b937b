// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/reference/level_qp.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/math/rank.h"

namespace poise {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// Iterations per row, after which Bland's rule selects the row to remove. The
// rule is slow, but cannot cycle in exact arithmetic.
constexpr int kIterationsBeforeBland = 10;

// Limit of removals of one row by Bland's rule. On a level that is met,
// residuals are rounding. A row removed for rounding need not move away from
// its bound, so it can block the next step, and the search could repeat this
// for ever.
constexpr int kMaxRemovals = 10;

// Solves the least-squares problem L x + l = 0. `norms` are the norms of the
// rows before any projection. A row below kRankTolerance of its norm is zero.
class LeastSquares {
 public:
  LeastSquares() = default;
  LeastSquares(const Eigen::MatrixXd& L, const Eigen::VectorXd& norms,
               RowSpaceMethod method) {
    const Eigen::VectorXd scale =
        (norms.array() > 0).select(norms.cwiseInverse(), 0);
    const RowSpace space = MakeRowSpace(scale.asDiagonal() * L, method);
    const int rows = static_cast<int>(L.rows());
    rank_ = space.rank;
    factor_ = Eigen::VectorXd::Ones(rows);
    order_ = Eigen::VectorXi::LinSpaced(rows, 0, rows - 1);
    range_ = space.V.leftCols(rank_);
    if (rank_ == 0) return;
    // The rows are combinations of an orthonormal basis, in the order of their
    // remaining norms, which keeps small-norm rows accurate. A row that depends
    // on the rows before does so exactly. Otherwise the rounding of its
    // remainder, times an unattainable residual, could outweigh a small-norm
    // row.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> basis(
        (L * range_).transpose());
    range_ = range_ * basis.householderQ();
    order_ = basis.colsPermutation().indices();
    // Independent rows can all be met, so their scales do not matter.
    if (rank_ == rows) factor_ = scale;
    parts_ = Eigen::MatrixXd::Zero(rows, rank_);
    for (int place = 0; place < rows; ++place) {
      const int i = order_[place];
      const auto part =
          basis.matrixQR().col(place).head(std::min(place + 1, rank_));
      for (int e = 0; e < part.size(); ++e) {
        const double rest = part.tail(part.size() - e).norm();
        if (rest <= kRankTolerance * norms[i]) break;
        parts_(place, e) = factor_[i] * part[e];
      }
    }
    // Every row can be within rounding of zero, by its own norm, although the
    // SVD of the scaled rows finds a rank. Dividing by such a row would give
    // NaN.
    if (parts_.isZero(0)) {
      rank_ = 0;
      return;
    }
    qr_.compute(parts_);
  }

  // Returns the solution of minimum norm.
  Eigen::VectorXd Solve(const Eigen::VectorXd& l) const {
    if (rank_ == 0) return Eigen::VectorXd::Zero(range_.rows());
    const Eigen::VectorXd right = -InOrder(factor_.cwiseProduct(l));
    Eigen::VectorXd x = qr_.solve(right);
    x += qr_.solve(right - parts_ * x);
    return range_ * x;
  }

  // Returns the part of a residual that no x reduces. The other part is
  // rounding at the solution, and is left out. So the small residuals of
  // large-norm rows have as many digits as those of small-norm rows. `size` is
  // the magnitude of the terms of each residual.
  Eigen::VectorXd Unreachable(const Eigen::VectorXd& residual,
                              const Eigen::VectorXd& size) const {
    Eigen::VectorXd left = InOrder(residual);
    const Eigen::VectorXd rounding = kEps * InOrder(size);
    if (rank_ > 0) left.applyOnTheLeft(qr_.householderQ().adjoint());
    left.head(rank_).setZero();
    for (int place = rank_; place < left.size(); ++place) {
      if (std::abs(left[place]) <= rounding[place]) left[place] = 0;
    }
    if (rank_ > 0) left.applyOnTheLeft(qr_.householderQ());
    Eigen::VectorXd unreachable(left.size());
    for (int place = 0; place < left.size(); ++place) {
      unreachable[order_[place]] = left[place];
    }
    return unreachable;
  }

  // Returns the entries of `of` for rows that depend on earlier rows, and 0 for
  // other rows.
  Eigen::VectorXd Dependent(const Eigen::VectorXd& of) const {
    Eigen::VectorXd dependent = of;
    for (int place = 0; place < rank_; ++place) dependent[order_[place]] = 0;
    return dependent;
  }

 private:
  Eigen::VectorXd InOrder(const Eigen::VectorXd& x) const {
    Eigen::VectorXd in_order(x.size());
    for (int place = 0; place < x.size(); ++place) {
      in_order[place] = x[order_[place]];
    }
    return in_order;
  }

  int rank_ = 0;
  Eigen::VectorXi order_;  // Row by place.
  Eigen::VectorXd factor_;
  Eigen::MatrixXd range_, parts_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};

class ActiveSet {
 public:
  ActiveSet(RowSpaceMethod method, LevelQp* qp)
      : method_(method), qp_(*qp), removals_left_(qp->P.rows(), kMaxRemovals) {}

  // Makes one iteration. Returns whether z is the optimum.
  bool Iterate() {
    ++iterations_;
    Collect();
    const Eigen::VectorXd step = Step();
    const int blocking = StepToBlockingConstraint(step);
    if (blocking >= 0) return false;
    const int removed = FindConstraintToRemove();
    if (removed >= 0) RemoveConstraint(removed);
    return removed < 0;
  }

 private:
  int rows() const { return static_cast<int>(qp_.P.rows()); }
  bool IsBland() const { return iterations_ > kIterationsBeforeBland * rows(); }

  double Bound(int i) const {
    return qp_.side[i] == Side::kUpper ? qp_.upper[i] : qp_.lower[i];
  }

  // Collects the rows of the equality-constrained problem of the working set.
  void Collect() {
    hard_.clear();
    soft_.clear();
    for (int i = 0; i < rows(); ++i) {
      if (qp_.side[i] != Side::kNone)
        (qp_.soft[i] ? soft_ : hard_).push_back(i);
    }
    const int met = static_cast<int>(qp_.M.rows());
    L_.resize(met + soft_.size(), qp_.M.cols());
    l_.resize(L_.rows());
    norms_.resize(L_.rows());
    L_.topRows(met) = qp_.M;
    l_.head(met) = qp_.M * qp_.z + qp_.m;
    norms_.head(met) = qp_.M_norm;
    for (size_t s = 0; s < soft_.size(); ++s) {
      const int i = soft_[s];
      L_.row(met + s) = qp_.P.row(i);
      l_[met + s] = qp_.P.row(i).dot(qp_.z) + qp_.value[i] - Bound(i);
      norms_[met + s] = qp_.P_norm[i];
    }
    A_.resize(hard_.size(), qp_.M.cols());
    for (size_t h = 0; h < hard_.size(); ++h) {
      A_.row(h) = qp_.P.row(hard_[h]) / qp_.P_norm[hard_[h]];
    }
  }

  // Returns the step to the optimum of the working set.
  Eigen::VectorXd Step() {
    const RowSpace space = MakeRowSpace(A_, RowSpaceMethod::kCod);
    const Eigen::MatrixXd N = space.V.rightCols(A_.cols() - space.rank);
    least_squares_ = LeastSquares(L_ * N, norms_, method_);
    return N * least_squares_.Solve(l_);
  }

  // Moves z along the step, up to the first bound outside the working set, and
  // adds that row to it. Returns the row, or -1 if none blocks.
  int StepToBlockingConstraint(const Eigen::VectorXd& step) {
    int blocking = -1;
    double length = 1;
    for (int i = 0; i < rows(); ++i) {
      if (qp_.side[i] != Side::kNone) continue;
      const double slope = qp_.P.row(i).dot(step);
      if (std::abs(slope) <= kNegligible * qp_.P_norm[i] * step.norm()) {
        continue;
      }
      const double value = qp_.P.row(i).dot(qp_.z) + qp_.value[i];
      const double gap =
          slope > 0 ? qp_.upper[i] - value : qp_.lower[i] - value;
      const double to_bound = std::max(gap / slope, 0.0);
      if (to_bound < length) {
        length = to_bound;
        blocking = i;
      }
    }
    qp_.z += length * step;
    if (blocking >= 0) {
      qp_.side[blocking] =
          qp_.P.row(blocking).dot(step) > 0 ? Side::kUpper : Side::kLower;
    }
    return blocking;
  }

  // Returns the magnitude of the terms of each residual of L_.
  Eigen::VectorXd TermsSize() const {
    Eigen::VectorXd size = qp_.z.norm() * norms_;
    size.head(qp_.M.rows()) += qp_.M_size;
    for (size_t s = 0; s < soft_.size(); ++s) {
      size[qp_.M.rows() + s] += qp_.size[soft_[s]];
    }
    return size;
  }

  // Returns the row with the most negative multiplier, or, by Bland's rule, the
  // first row with a negative one; -1 if there is none.
  int FindConstraintToRemove() {
    const int met = static_cast<int>(qp_.M.rows());
    Eigen::VectorXd residual(L_.rows());
    residual.head(met) = qp_.M * qp_.z + qp_.m;
    for (size_t s = 0; s < soft_.size(); ++s) {
      const int i = soft_[s];
      residual[met + s] = qp_.P.row(i).dot(qp_.z) + qp_.value[i] - Bound(i);
    }
    const Eigen::VectorXd sizes = TermsSize();
    residual = least_squares_.Unreachable(residual, sizes);
    const Eigen::VectorXd force = norms_.cwiseProduct(residual.cwiseAbs());
    int removed = -1;
    double worst = 0;
    const bool bland = IsBland();
    const auto consider = [&](int i, double multiplier, double size) {
      if (removals_left_[i] == 0) return;
      const double signed_ratio =
          (qp_.side[i] == Side::kUpper ? multiplier : -multiplier) / size;
      if (bland ? signed_ratio < 0 && (removed < 0 || i < removed)
                : signed_ratio < worst) {
        worst = signed_ratio;
        removed = i;
      }
    };
    for (size_t s = 0; s < soft_.size(); ++s) {
      if (force[met + s] <= kNegligible * force.maxCoeff()) continue;
      consider(soft_[s], residual[met + s], sizes[met + s]);
    }
    if (!hard_.empty()) {
      const Eigen::VectorXd gradient = L_.transpose() * residual;
      // The terms of the gradient are the residuals, and the rounding of the
      // terms of the residuals.
      const double size =
          force.sum() +
          kEps / kNegligible * norms_.dot(least_squares_.Dependent(sizes));
      const Eigen::VectorXd multipliers =
          A_.transpose().colPivHouseholderQr().solve(-gradient);
      for (size_t h = 0; h < hard_.size(); ++h) {
        if (std::abs(multipliers[h]) <= kNegligible * size) continue;
        consider(hard_[h], multipliers[h], size);
      }
    }
    return removed;
  }

  // Removes a row from the working set. If z violates the other bound of a soft
  // row, the row stays, at that bound.
  void RemoveConstraint(int i) {
    if (IsBland()) --removals_left_[i];
    const Side side = qp_.side[i];
    const double value = qp_.P.row(i).dot(qp_.z) + qp_.value[i];
    qp_.side[i] = Side::kNone;
    if (!qp_.soft[i]) return;
    if (side == Side::kUpper && value < qp_.lower[i]) {
      qp_.side[i] = Side::kLower;
    } else if (side == Side::kLower && value > qp_.upper[i]) {
      qp_.side[i] = Side::kUpper;
    }
  }

  RowSpaceMethod method_;
  LevelQp& qp_;
  LeastSquares least_squares_;
  std::vector<int> hard_, soft_;  // Rows in the working set.
  Eigen::MatrixXd L_, A_;
  Eigen::VectorXd l_, norms_;
  int iterations_ = 0;
  std::vector<int> removals_left_;  // By row, with Bland's rule.
};

}  // namespace

int SolveLevelQp(RowSpaceMethod method, int max_iterations, LevelQp* qp) {
  ActiveSet active_set(method, qp);
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    if (active_set.Iterate()) return iteration;
  }
  return -1;
}

}  // namespace poise
