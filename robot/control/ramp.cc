// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/ramp.h"

#include <algorithm>

namespace poise {
namespace {

// From 1 to 0 for s from 0 to 1, at rest at both ends, of least jerk.
double Left(double s) {
  return s < 1 ? 1 - s * s * s * (10 + s * (-15 + s * 6)) : 0;
}

}  // namespace

void Ramp::Begin() noexcept {
  if (!(duration_ > 0 && dt_ > 0)) return;
  elapsed_ = 0;
  Choose();
}

void Ramp::End() noexcept {
  keep_ = 0;
  dt_ = 0;
}

void Ramp::Advance(double dt, const Eigen::VectorXd& y) noexcept {
  dt_ = dt;
  y_last_ = y;
  if (!is_on()) return;
  elapsed_ += dt;
  Choose();
}

void Ramp::Choose() noexcept {
  const double left = Left(elapsed_ / duration_);
  keep_ = left > 0 ? Left((elapsed_ + dt_) / duration_) / left : 0;
}

void Ramp::Ease(EqualityBlock* equalities) const noexcept {
  for (Eigen::Index i = 0; i < equalities->b.size(); ++i) {
    const double off = equalities->B.row(i).dot(y_last_) + equalities->b[i];
    equalities->b[i] -= keep_ * off;
  }
}

void Ramp::Ease(InequalityBlock* inequalities) const noexcept {
  for (Eigen::Index i = 0; i < inequalities->lower.size(); ++i) {
    const double at = inequalities->C.row(i).dot(y_last_);
    double& lower = inequalities->lower[i];
    double& upper = inequalities->upper[i];
    if (at < lower) lower -= keep_ * (lower - at);
    if (at > upper) upper += keep_ * (at - upper);
  }
}

void Ramp::Hold(EqualityBlock* equalities) const noexcept {
  equalities->B.setIdentity();
  equalities->b = -keep_ * y_last_;
}

}  // namespace poise
