// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/center_of_mass_path.h"

#include <algorithm>
#include <cmath>

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
  // s = 10 x^3 - 15 x^4 + 6 x^5, x from 0 to 1.
  const double x = std::clamp((time - start_) / over_, 0.0, 1.0);
  const double s = x * x * x * (10 + x * (6 * x - 15));
  const double ds = 30 * x * x * (x - 1) * (x - 1) / over_;
  const double dds = 60 * x * (2 * x - 1) * (x - 1) / (over_ * over_);
  const Eigen::Vector3d way = to_ - from_;

  const double w = 2 * kPi / motion_.period;
  const double sine = std::sin(w * time), cosine = std::cos(w * time);
  const Eigen::Vector3d swing = sine * motion_.sine + cosine * motion_.cosine;
  reference->p_WG = from_ + s * way + swing;
  reference->v_WG =
      ds * way + w * (cosine * motion_.sine - sine * motion_.cosine);
  reference->a_WG = dds * way - w * w * swing;
}

}  // namespace poise
