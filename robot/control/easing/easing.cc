// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/easing/easing.h"

#include <algorithm>

namespace poise {
namespace {

double Residual(const EqualityBlock& rows, Eigen::Index i,
                const Eigen::VectorXd& y) {
  return rows.B.row(i).dot(y) + rows.b[i];
}

}  // namespace

Easing::Easing(int num_variables)
    : lacked_(Eigen::VectorXd::Zero(num_variables)),
      y_last_(Eigen::VectorXd::Zero(num_variables)) {
  ramp_.Resize(num_variables);
}

int Easing::AddTask(int equalities, int inequalities) {
  const int rows = static_cast<int>(lacked_.size());
  lacked_.setZero(rows + equalities + 2 * inequalities);
  ramp_.Resize(static_cast<int>(lacked_.size()));
  return rows;
}

void Easing::set_duration(double seconds) noexcept {
  ramp_.set_duration(seconds);
  if (seconds == 0) ramp_.Clear();
}

void Easing::Advance(double dt, const Eigen::VectorXd& y) noexcept {
  dt_ = dt;
  y_last_ = y;
  lacked_.setZero();
  for (int i = 0; i < y.size(); ++i) lacked_[i] = y[i] - ramp_[i];
  ramp_.Advance(dt);
  holds_ = holds();
}

void Easing::Remember(int rows,
                      const Eigen::Ref<const Eigen::VectorXd>& residual,
                      const Eigen::Ref<const Eigen::VectorXd>& slack,
                      double scale) noexcept {
  const auto lower = rows + residual.size();
  lacked_.segment(rows, residual.size()) = residual;
  lacked_.segment(lower, slack.size()) = slack / scale;
  lacked_.segment(lower + slack.size(), slack.size()) = slack / scale;
}

void Easing::End() noexcept {
  ramp_.Clear();
  dt_ = 0;
  holds_ = false;
}

void Easing::BeginAtLast(int rows, const EqualityBlock& now) noexcept {
  for (Eigen::Index i = 0; i < now.b.size(); ++i) {
    const int row = rows + static_cast<int>(i);
    ramp_.Add(row, Residual(now, i, y_last_) - ramp_[row]);
  }
}

// In the optimality condition, a row counts with weight times residual. After a
// change of the weight, the residual is scaled so that this product stays the
// same.
void Easing::BeginAsBefore(int rows, const EqualityBlock& now,
                           const EqualityBlock& before,
                           double weight_ratio) noexcept {
  for (Eigen::Index i = 0; i < now.b.size(); ++i) {
    const int row = rows + static_cast<int>(i);
    const double ratio =
        now.weight[i] > 0 ? weight_ratio * before.weight[i] / now.weight[i] : 1;
    ramp_.Add(row, Residual(now, i, y_last_) - Residual(before, i, y_last_) +
                       (1 - ratio) * lacked_[row]);
  }
}

void Easing::KeepResiduals(int rows, int equalities) noexcept {
  for (int row = rows; row < rows + equalities; ++row) {
    ramp_.Add(row, lacked_[row]);
    lacked_[row] = 0;
  }
}

void Easing::KeepFree() noexcept {
  KeepResiduals(0, static_cast<int>(y_last_.size()));
  holds_ = true;
}

void Easing::BeginInside(int rows, int equalities,
                         const InequalityBlock& now) noexcept {
  const int size = static_cast<int>(now.lower.size());
  const int lower = rows + equalities;
  const int upper = lower + size;
  for (int i = 0; i < size; ++i) {
    const double at = now.C.row(i).dot(y_last_);
    const auto begin = [this](int row, double violation) {
      ramp_.Add(row, std::max(0.0, violation - lacked_[row] - ramp_[row]));
    };
    begin(lower + i, now.lower[i] - at);
    begin(upper + i, at - now.upper[i]);
  }
}

void Easing::Ease(int rows, EqualityBlock* equalities) const noexcept {
  for (int i = 0; i < static_cast<int>(equalities->b.size()); ++i) {
    const double offset = ramp_[rows + i];
    // A zero row has no effect in this tick: b must stay zero.
    if (offset == 0 || equalities->B.row(i).isZero(0)) continue;
    equalities->b[i] -= offset;
  }
}

// An offset that reaches zero with nonzero rate overshoots. A negative offset
// must not tighten a bound.
void Easing::Ease(int rows, int equalities,
                  InequalityBlock* inequalities) const noexcept {
  const int size = static_cast<int>(inequalities->lower.size());
  const int lower = rows + equalities;
  const int upper = lower + size;
  for (int i = 0; i < size; ++i) {
    inequalities->lower[i] -= std::max(0.0, ramp_[lower + i]);
    inequalities->upper[i] += std::max(0.0, ramp_[upper + i]);
  }
}

void Easing::Hold(EqualityBlock* equalities) const noexcept {
  for (int j = 0; j < static_cast<int>(equalities->b.size()); ++j) {
    equalities->SetSingle(j, j, 1);
  }
  for (int i = 0; i < static_cast<int>(y_last_.size()); ++i) {
    equalities->b[i] = -ramp_[i];
  }
}

}  // namespace poise
