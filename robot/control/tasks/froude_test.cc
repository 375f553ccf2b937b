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

TEST_F(FroudeTest, KeepsDampingRatiosAnglesAndWeights) {
  const auto ratio = [&](const char* task) {
    return Get(task, "kd") / std::sqrt(Get(task, "kp"));
  };
  const double contact = ratio("contact");
  const double posture = ratio("posture");
  const double margin = Get("joint_limits", "margin");
  const double weight = Get("momentum", "angular_weight");
  const double d_min = Get("self_collision", "d_min");
  ScaleAll(0.3 * kTunedComHeight);
  EXPECT_NEAR(ratio("contact") / contact, 1, kRounding);
  EXPECT_NEAR(ratio("posture") / posture, 1, kRounding);
  EXPECT_EQ(Get("joint_limits", "margin"), margin);
  EXPECT_EQ(Get("momentum", "angular_weight"), weight);
  EXPECT_EQ(Get("self_collision", "d_min"), d_min);
}

}  // namespace
}  // namespace poise
