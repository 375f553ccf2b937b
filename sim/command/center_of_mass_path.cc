// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/center_of_mass_path.h"

#include <algorithm>
#include <cmath>

#include "poise/robot/control/easing/minimum_jerk.h"

namespace poise {

namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

void CenterOfMassPath::ShiftTo(const Eigen::Vector3d& place, double time,
                               double over) {
  from_ = to_;
  to_ = place;
  start_ = time;
  over_ = over;
}

void CenterOfMassPath::Write(double time, Reference* reference) const {
  const double x = std::clamp((time - start_) / over_, 0.0, 1.0);
  const MinimumJerk s(x);
  const double rate = s.rate / over_;
  const double acceleration = s.acceleration / (over_ * over_);
  const Eigen::Vector3d way = to_ - from_;

  const double w = 2 * kPi / motion_.period;
  const double sine = std::sin(w * time), cosine = std::cos(w * time);
  const Eigen::Vector3d swing = sine * motion_.sine + cosine * motion_.cosine;
  reference->p_WG = from_ + s.value * way + swing;
  reference->v_WG =
      rate * way + w * (cosine * motion_.sine - sine * motion_.cosine);
  reference->a_WG = acceleration * way - w * w * swing;
}

}  // namespace poise
