// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/eased_vector.h"

#include <algorithm>

#include "poise/robot/control/easing/minimum_jerk.h"

namespace poise {

void EasedVector::GoTo(const Eigen::Vector3d& target, double time,
                       double over) {
  from_ = to_;
  to_ = target;
  start_ = time;
  over_ = over;
}

EasedVector::Motion EasedVector::At(double time) const {
  const MinimumJerk s(std::clamp((time - start_) / over_, 0.0, 1.0));
  const double rate = s.rate / over_;
  const double acceleration = s.acceleration / (over_ * over_);
  const Eigen::Vector3d way = to_ - from_;
  return {from_ + s.value * way, rate * way, acceleration * way};
}

}  // namespace poise
