// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/swing_path.h"

namespace poise {
namespace {

// With less time than this, a quintic to a goal that still moves would need
// absurd accelerations: the coordinate brakes instead.
constexpr double kLeastTime = 0.012;  // s.
constexpr double kBrakeTime = 0.005;  // s.

// The sole takes this time to change to the search speed.
constexpr double kSearchTime = 0.02;  // s.

void Approach(double dt, double goal, double time, Quintic* x) noexcept {
  if (time > kLeastTime) {
    x->Advance(dt, goal, time);
  } else {
    x->Brake(dt, kBrakeTime);
  }
}

}  // namespace

void SwingPath::Start(const Eigen::Vector2d& p_WC, double height) noexcept {
  plane_ = {Quintic{p_WC.x(), 0, 0}, Quintic{p_WC.y(), 0, 0}};
  height_ = {height, 0, 0};
}

void SwingPath::Advance(double dt, const Eigen::Vector2d& goal_WC, double over,
                        double duration) noexcept {
  const double plane_time = settings_.above_at * duration - over;
  for (int i = 0; i < 2; ++i) Approach(dt, goal_WC[i], plane_time, &plane_[i]);

  if (over < settings_.descend_from * duration) {
    Approach(dt, settings_.clearance, settings_.risen_at * duration - over,
             &height_);
  } else if (duration - over > kLeastTime) {
    height_.Advance(dt, 0, duration - over);
  } else {
    // Brakes to the search speed instead of to rest.
    const double speed =
        height_.p > -settings_.search_depth ? settings_.search_speed : 0;
    height_.v += speed;
    height_.Brake(dt, kSearchTime);
    height_.v -= speed;
    height_.p -= speed * dt;
  }
}

void SwingPath::Write(const Eigen::Matrix3d& R_WC, double ground_z,
                      FrameReference* out) const noexcept {
  const Quintic& x = plane_[0];
  const Quintic& y = plane_[1];
  out->X_WF.R = R_WC;
  out->X_WF.p << x.p, y.p, ground_z + height_.p;
  out->V_WF_W << 0, 0, 0, x.v, y.v, height_.v;
  out->A_WF_W << 0, 0, 0, x.a, y.a, height_.a;
}

}  // namespace poise
