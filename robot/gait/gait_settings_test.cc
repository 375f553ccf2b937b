// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/gait_settings.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/balance_monitor.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Gravity cancels: any value is right.
constexpr double kGravity = 9.81;

// Numbers without a unit that decide about a step, for a robot whose center of
// mass is at a height: Froude's rule keeps them.
std::vector<double> Dimensionless(const GaitSettings& s, double height) {
  const double omega = PendulumFrequency(kGravity, height);
  const double speed = omega * height;
  return {omega * s.time_min,
          omega * s.time_max,
          omega * s.freeze,
          omega * s.shift_time,
          omega * s.command_time,
          omega * s.rest_time,
          s.swing_speed / speed,
          s.sole_gap / height,
          s.min_sink / height,
          s.square / height,
          s.time_weight / (height * height),
          s.angular_weight * height * height,
          s.region.max_sink / height,
          s.path.clearance / height,
          s.path.search_depth / height,
          s.path.search_speed / speed,
          s.command_path.clearance / height,
          s.command_path.search_depth / height,
          s.command_path.search_speed / speed};
}

RC_GTEST_PROP(GaitSettings, KeepDimensionlessNumbers, ()) {
  const double height = 0.05 * *rc::gen::inRange(4, 40);  // m.
  const GaitSettings tuned;
  const std::vector<double> before =
      Dimensionless(tuned, GaitSettings::kTunedHeight);
  const std::vector<double> after =
      Dimensionless(Scaled(tuned, height), height);
  for (std::size_t i = 0; i < before.size(); ++i) {
    // Four roundings each.
    RC_ASSERT(std::abs(after[i] - before[i]) <= 1e-15 * 8 * before[i]);
  }
}

TEST(GaitSettingsTest, AccelerationsAnglesAndPushesDoNotScale) {
  const GaitSettings tuned;
  const GaitSettings scaled = Scaled(tuned, 3 * GaitSettings::kTunedHeight);
  EXPECT_EQ(scaled.dt, tuned.dt);
  EXPECT_EQ(scaled.push.noticed, tuned.push.noticed);
  EXPECT_EQ(scaled.push.expected, tuned.push.expected);
  EXPECT_EQ(scaled.region.limit_margin, tuned.region.limit_margin);
  EXPECT_EQ(scaled.first_rise, tuned.first_rise);
  EXPECT_EQ(scaled.trigger.lateral, tuned.trigger.lateral);
}

// The humanoid's own settings are the defaults, to the bit.
TEST(GaitSettingsTest, DefaultsAreThoseOfTheHumanoid) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv()), &tick);
  const GaitSettings tuned;
  const GaitSettings scaled = Scaled(tuned, tick.p_WG.z());
  EXPECT_EQ(Dimensionless(scaled, 1), Dimensionless(tuned, 1));
}

}  // namespace
}  // namespace poise
