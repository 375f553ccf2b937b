// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/froude.h"

#include <gtest/gtest.h>

#include <cmath>

#include "poise/robot/control/default_stack.h"
#include "poise/robot/control/stack.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Four roundings of numbers near 1, in std::pow and in the products.
constexpr double kRounding = 1e-14;

class FroudeTest : public testing::Test {
 protected:
  void ScaleAll(double height) {
    for (int i = 0; i < stack_.num_tasks(); ++i) {
      ScaleToHeight(height, stack_.task(i));
    }
  }

  double Get(const char* task, const char* parameter) const {
    return stack_.GetParameter(task, parameter).value();
  }

  Stack stack_ = MakeDefaultStack(LoadHumanoid(), {});
};

TEST_F(FroudeTest, KeepsTheDefaultsOfTheTunedRobot) {
  const Stack tuned = MakeDefaultStack(LoadHumanoid(), {});
  ScaleAll(kTunedComHeight * (1 + 1e-4));
  for (int i = 0; i < stack_.num_tasks(); ++i) {
    for (const Parameter& parameter : stack_.task(i).parameters()) {
      const auto value =
          tuned.GetParameter(tuned.task(i).name(), parameter.name);
      EXPECT_EQ(*parameter.value, value) << parameter.name;
    }
  }
}

// A robot four times as high moves half as fast.
TEST_F(FroudeTest, ScalesRatesWithTheRootOfTheHeight) {
  const double rate = Get("momentum", "kd");
  const double stiffness = Get("momentum", "kp");
  const double integral = Get("momentum", "ki");
  const double margin = Get("cop", "margin");
  const double omega = Get("joint_limits", "omega");
  ScaleAll(4 * kTunedComHeight);
  EXPECT_NEAR(Get("momentum", "kd") / rate, 0.5, kRounding);
  EXPECT_NEAR(Get("momentum", "kp") / stiffness, 0.25, kRounding);
  EXPECT_NEAR(Get("momentum", "ki") / integral, 0.125, kRounding);
  EXPECT_NEAR(Get("cop", "margin") / margin, 4, kRounding);
  EXPECT_NEAR(Get("joint_limits", "omega") / omega, 0.5, kRounding);
}

// The row of angular momentum is in m2/s2, that of the linear one in m/s2.
TEST_F(FroudeTest, ScalesWeightsOfAngularMomentumWithTheSquare) {
  const double weight = Get("momentum", "angular_weight");
  const double captured = Get("momentum", "capture_angular_weight");
  ScaleAll(2 * kTunedComHeight);
  EXPECT_NEAR(Get("momentum", "angular_weight") / weight, 0.25, kRounding);
  EXPECT_NEAR(Get("momentum", "capture_angular_weight") / captured, 0.25,
              kRounding);
}

TEST(MakeFroudeScale, IsOneForTheTunedRobot) {
  const FroudeScale scale = MakeFroudeScale(LoadHumanoid());
  EXPECT_EQ(scale.length, 1);
  EXPECT_EQ(scale.mass, 1);
}

TEST(MakeFroudeScale, IsTheRatioOfHeightsAndMasses) {
  Robot robot = LoadHumanoid();
  robot.model.tree = robot.model.tree.WithScaledInertias(2);
  // The soles are lowered in the feet: the robot is higher by as much.
  for (Foot& foot : robot.feet) foot.X_BC.p.z() -= 0.5 * kTunedComHeight;
  const FroudeScale scale = MakeFroudeScale(robot);
  EXPECT_NEAR(scale.mass, 2, kRounding);
  // The ankles are level to 1e-7 rad in the profile's posture.
  EXPECT_NEAR(scale.length, 1.5, 1e-6);
  EXPECT_NEAR(scale.inertia(), 4.5, 1e-5);
  robot.feet.clear();
  EXPECT_EQ(MakeFroudeScale(robot).length, 1);
}

TEST_F(FroudeTest, KeepsDampingRatiosAnglesAndWeights) {
  const auto ratio = [&](const char* task) {
    return Get(task, "kd") / std::sqrt(Get(task, "kp"));
  };
  const double contact = ratio("contact");
  const double posture = ratio("posture");
  const double margin = Get("joint_limits", "margin");
  const double weight = Get("momentum", "capture_height_weight");
  const double d_min = Get("self_collision", "d_min");
  ScaleAll(0.3 * kTunedComHeight);
  EXPECT_NEAR(ratio("contact") / contact, 1, kRounding);
  EXPECT_NEAR(ratio("posture") / posture, 1, kRounding);
  EXPECT_EQ(Get("joint_limits", "margin"), margin);
  EXPECT_EQ(Get("momentum", "capture_height_weight"), weight);
  EXPECT_EQ(Get("self_collision", "d_min"), d_min);
}

}  // namespace
}  // namespace poise
