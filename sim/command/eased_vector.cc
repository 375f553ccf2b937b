// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/eased_vector.h"

#include <algorithm>

#include "poise/robot/control/easing/minimum_jerk.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// A polynomial of s in [0, 1] and its derivatives by s.
struct Polynomial {
  double value, first, second;
};

// The polynomials of degree 5 that begin with a first, or second, derivative of
// 1. All their other values and derivatives at 0 and 1 are 0. With them, the
// path of minimum jerk begins in motion.
Polynomial FromRate(double s) {
  return {s * (1 + s * s * (-6 + s * (8 - 3 * s))),
          1 + s * s * (-18 + s * (32 - 15 * s)), s * (-36 + s * (96 - 60 * s))};
}

Polynomial FromAcceleration(double s) {
  return {s * s * (0.5 + s * (-1.5 + s * (1.5 - 0.5 * s))),
          s * (1 + s * (-4.5 + s * (6 - 2.5 * s))),
          1 + s * (-9 + s * (18 - 10 * s))};
}

}  // namespace

void EasedVector::GoTo(const Vector3d& target, double time, double over) {
  const bool has_arrived = time >= start_ + over_;
  from_ =
      has_arrived ? Motion{to_, Vector3d::Zero(), Vector3d::Zero()} : At(time);
  to_ = target;
  start_ = time;
  over_ = over;
}

EasedVector::Motion EasedVector::At(double time) const {
  const double s = std::clamp((time - start_) / over_, 0.0, 1.0);
  const MinimumJerk rest(s);
  const Polynomial rate = FromRate(s), acceleration = FromAcceleration(s);
  const Vector3d way = to_ - from_.value;
  const Vector3d &v = from_.rate, &a = from_.acceleration;
  return {
      from_.value + rest.value * way + over_ * rate.value * v +
          over_ * over_ * acceleration.value * a,
      rest.rate / over_ * way + rate.first * v + over_ * acceleration.first * a,
      rest.acceleration / (over_ * over_) * way + rate.second / over_ * v +
          acceleration.second * a};
}

}  // namespace poise
