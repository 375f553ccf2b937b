// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/lean_path.h"

#include <algorithm>

#include "poise/math/so3.h"
#include "poise/robot/control/easing/minimum_jerk.h"

namespace poise {

void LeanPath::LeanTo(const Eigen::Vector3d& lean_W, double time, double over) {
  from_ = to_;
  to_ = lean_W;
  start_ = time;
  over_ = over;
}

void LeanPath::Write(double time, Reference* reference) const {
  if (from_.isZero(0) && to_.isZero(0)) return;
  const MinimumJerk s(std::clamp((time - start_) / over_, 0.0, 1.0));
  reference->R_WB =
      ExpSo3(Eigen::Vector3d(from_ + s.value * (to_ - from_))) * start_R_WB_;
}

}  // namespace poise
