// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/swing_path.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/tests/util/arbitrary.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;

FrameReference At(const SwingPath& path) {
  FrameReference out;
  path.Write(Eigen::Matrix3d::Identity(), 0, &out);
  return out;
}

TEST(SwingPath, RisesTravelsAndLandsAtRest) {
  const SwingPath::Settings settings;
  SwingPath path;
  path.Configure(settings);
  path.Start({0.1, -0.2}, 0.001);
  const Eigen::Vector2d goal(0.5, 0.1);
  const double duration = 0.3;
  double highest = 0;
  for (int i = 0; i < 300; ++i) {
    path.Advance(kDt, goal, i * kDt, duration);
    const FrameReference at = At(path);
    highest = std::max(highest, at.X_WF.p.z());
    if (i * kDt > settings.above_at * duration) {
      // The last 12 ms before this time brake, and move the foot no further
      // than its small speed by then.
      EXPECT_LT((at.X_WF.p.head<2>() - goal).norm(), 2e-3) << i;
    }
  }
  EXPECT_NEAR(highest, settings.clearance, 1e-3);
  EXPECT_NEAR(At(path).X_WF.p.z(), 0, 5e-3);  // Sinks for the last 12 ms.
  // Late landing: the sole sinks at the search speed.
  for (int i = 300; i < 400; ++i) path.Advance(kDt, goal, i * kDt, duration);
  EXPECT_NEAR(At(path).V_WF_W[5], -settings.search_speed, 0.01);
  EXPECT_NEAR(At(path).X_WF.p.z(), -0.1 * settings.search_speed, 5e-3);
  // Without any ground, it stops at the search depth.
  for (int i = 400; i < 2000; ++i) path.Advance(kDt, goal, i * kDt, duration);
  EXPECT_NEAR(At(path).X_WF.p.z(), -settings.search_depth, 0.01);
  EXPECT_NEAR(At(path).V_WF_W[5], 0, 1e-6);
}

// The path stands still over its place before the planned landing, if the
// place does not change in the last 50 ms.
RC_GTEST_PROP(SwingPath, HasNoSpeedAlongTheGroundAtThePlannedLanding, ()) {
  const SwingPath::Settings settings;
  SwingPath path;
  path.Configure(settings);
  path.Start(Eigen::Vector2d::Zero(), 0);
  Eigen::Vector2d goal = 0.4 * (*VectorsXd(2, 1)).head<2>();
  const double duration = 0.22 + *Numbers(0.02);
  double over = 0;
  for (; over < duration; over += kDt) {
    if (duration - over > 0.05) goal += 1e-3 * (*VectorsXd(2, 1)).head<2>();
    path.Advance(kDt, goal, over, duration);
  }
  // At the start of braking, 12 ms before the path is over its place at 190
  // ms, the quintic of 0.6 m has 0.4 m/s. A further 23 ms of braking with a
  // time constant of 5 ms leave 1 % of this; a goal that moves to the end of
  // the 50 ms makes the quintic faster by a factor of 3.
  RC_ASSERT(At(path).V_WF_W.segment<2>(3).norm() < 0.02);
  RC_ASSERT((At(path).X_WF.p.head<2>() - goal).norm() < 5e-3);
}

// Velocities are the derivatives of the positions, and accelerations those of
// the velocities, also if the goal and the duration change in each tick.
RC_GTEST_PROP(SwingPath, IsConsistentWhenThePlanChanges, ()) {
  SwingPath path;
  path.Configure({});
  path.Start(Eigen::Vector2d::Zero(), 0);
  FrameReference before = At(path);
  Eigen::Vector2d goal(0.4, 0.2);
  double duration = 0.25;
  for (int i = 0; i < 350; ++i) {
    goal += 0.01 * (*VectorsXd(2, 1)).head<2>();
    duration = std::clamp(duration + *Numbers(0.002), 0.22, 0.3);
    path.Advance(kDt, goal, i * kDt, duration);
    const FrameReference now = At(path);
    for (int axis = 0; axis < 3; ++axis) {
      const double moved = now.X_WF.p[axis] - before.X_WF.p[axis];
      const double mean_v =
          (now.V_WF_W[3 + axis] + before.V_WF_W[3 + axis]) / 2;
      // The trapezoidal rule is wrong by dt³ / 12 times the third derivative,
      // which a step of 0.5 m in 12 ms, the shortest, bounds by 60 m / T³; a
      // change to braking adds a jump of the velocity's rate.
      RC_ASSERT(std::abs(moved - mean_v * kDt) < 2e-3);
      RC_ASSERT(std::isfinite(now.A_WF_W[3 + axis]));
    }
    before = now;
  }
}

}  // namespace
}  // namespace poise
