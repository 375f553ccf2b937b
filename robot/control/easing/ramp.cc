// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/easing/ramp.h"

namespace poise {

void Ramp::Resize(int size) {
  x_.setZero(3, size);
  left_ = 0;
}

void Ramp::Clear() noexcept {
  x_.setZero();
  left_ = 0;
}

void Ramp::Add(int i, double jump) noexcept {
  if (duration_ == 0 || jump == 0) return;
  x_(0, i) += jump;
  left_ = duration_;
}

// Advances by the fraction s = dt / T of the remaining time T. With value x,
// rate v and acceleration a at its start,
//     x(s) = (1 - s)^3 (x + (3 x + v T) s + (6 x + 3 v T + a T^2 / 2) s^2).
void Ramp::Advance(double dt) noexcept {
  if (!is_on()) return;
  const double T = left_;
  const double s = dt / T;
  // Only one tick is left, up to rounding: all values end at zero.
  if (s > 1 - 1e-6) {
    Clear();
    return;
  }
  const double r = 1 - s;
  Eigen::Matrix3d coefficients;  // For 1, s, s^2, second factor.
  coefficients << 1, 0, 0,       //
      3, T, 0,                   //
      6, 3 * T, T * T / 2;
  // Value, rate and acceleration at s.
  Eigen::Matrix3d at;
  at << r * r * r, r * r * r * s, r * r * r * s * s,  //
      -3 * r * r / T, r * r * (r - 3 * s) / T,        //
      r * r * s * (2 * r - 3 * s) / T,                //
      6 * r / (T * T), 6 * r * (s - r) / (T * T),     //
      2 * r * (r * r - 6 * r * s + 3 * s * s) / (T * T);
  const Eigen::Matrix3d step = at * coefficients;
  for (Eigen::Index i = 0; i < x_.cols(); ++i) {
    const Eigen::Vector3d x = x_.col(i);
    x_.col(i).noalias() = step * x;
  }
  left_ -= dt;
}

}  // namespace poise
