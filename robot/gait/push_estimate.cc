// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/push_estimate.h"

#include <algorithm>

namespace poise {

void PushEstimate::Reset() noexcept {
  a_WG_.setZero();
  acts_ = false;
  acted_for_ = quiet_for_ = 0;
}

void PushEstimate::Update(double dt, const Tick& tick,
                          const Eigen::VectorXd& unmodelled_vdot) noexcept {
  // Rows 3 and 4 of H_G: the linear momentum in the plane.
  for (int i = 0; i < 2; ++i) {
    a_WG_[i] = tick.H_G.row(3 + i).dot(unmodelled_vdot) / mass_;
  }
  acts_ = a_WG_.norm() > settings_.noticed;
  if (acts_) {
    acted_for_ += dt;
    quiet_for_ = 0;
  } else {
    quiet_for_ += dt;
    if (quiet_for_ > settings_.over_after) acted_for_ = 0;
  }
}

double PushEstimate::remaining() const {
  return acts_ ? std::max(0.0, settings_.expected - acted_for_) : 0;
}

}  // namespace poise
