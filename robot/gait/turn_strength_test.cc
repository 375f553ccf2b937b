// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/turn_strength.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "poise/dynamics/tree.h"
#include "poise/robot/gait/gait_settings.h"
#include "poise/robot/gait/step_trigger.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/random_biped.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Sets the effort limits of all joints whose names contain a word.
void Limit(const std::string& word, double effort, Robot* robot) {
  const Tree& tree = robot->model.tree;
  for (int j = 0; j < tree.num_joints(); ++j) {
    if (tree.joints()[j].name.find(word) == std::string::npos) continue;
    robot->model.limits[j].effort = effort;
  }
}

double Weight(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  return tree.total_mass() * tree.gravity_W().norm();
}

// Two hips move the CMP by 2 effort / (m g). An arm on the trunk, here the
// chain, does not bound the torque.
RC_GTEST_PROP(TurnStrength, IsThatOfBothHips, ()) {
  const BipedCase biped = *Bipeds();
  Robot robot = MakeBiped(biped);
  Limit("", 1e6, &robot);
  Limit("hip", 30, &robot);
  Limit("joint_", 0.1, &robot);
  const TurnStrength strength = ComputeTurnStrength(robot);
  const Eigen::Vector2d half = robot.feet[0].half_size;
  const double length = 2 * 30 / Weight(robot);
  // The efforts and masses are sums of a few numbers.
  RC_ASSERT(std::abs(strength.sagittal * half.x() - length) <=
            Rounding(length, 100, 1));
  RC_ASSERT(std::abs(strength.lateral * (biped.hip + half.y()) - length) <=
            Rounding(length, 100, 1));
}

// A waist bounds the torque about its own axis, and only about this one.
TEST(TurnStrengthTest, WeakWaistBoundsIt) {
  const Robot robot = LoadHumanoid();
  Robot weak = robot;
  Limit("chest_pitch", 10, &weak);
  const TurnStrength before = ComputeTurnStrength(robot);
  const TurnStrength after = ComputeTurnStrength(weak);
  const double length = 10 / Weight(weak);
  EXPECT_NEAR(after.sagittal * weak.feet[0].half_size.x(), length,
              Rounding(length, 100, 1));
  EXPECT_LT(after.sagittal, before.sagittal);
  EXPECT_EQ(after.lateral, before.lateral);
}

TEST(TurnStrengthTest, MissingLimitsGiveAnInfiniteStrength) {
  Robot robot = LoadHumanoid();
  Limit("", std::numeric_limits<double>::infinity(), &robot);
  EXPECT_TRUE(std::isinf(ComputeTurnStrength(robot).sagittal));
  const StepTrigger fit =
      FitToStrength({}, {0.5, 0.5, 1}, ComputeTurnStrength(robot));
  EXPECT_EQ(fit.sagittal, StepTrigger().sagittal);
}

// Our humanoid keeps the thresholds that were tuned for it, also with a model
// that is 10 % too heavy.
TEST(TurnStrengthTest, OurHumanoidIsStrong) {
  const GaitSettings settings;
  Robot robot = LoadHumanoid();
  robot.model.tree = robot.model.tree.WithScaledInertias(1.1);
  const StepTrigger fit = FitToStrength(settings.trigger, settings.weak_trigger,
                                        ComputeTurnStrength(robot));
  EXPECT_EQ(fit.sagittal, settings.trigger.sagittal);
  EXPECT_EQ(fit.lateral, settings.trigger.lateral);
  EXPECT_EQ(fit.sum, settings.trigger.sum);
}

// A threshold never falls as the robot gets stronger.
RC_GTEST_PROP(FitToStrength, IsMonotonic, ()) {
  const GaitSettings settings;
  const double s = 0.01 * *rc::gen::inRange(0, 1000);
  const double more = s + 0.01 * *rc::gen::inRange(1, 300);
  const auto fit = [&](double strength) {
    return FitToStrength(settings.trigger, settings.weak_trigger,
                         {strength, strength});
  };
  RC_ASSERT(fit(s).sagittal <= fit(more).sagittal);
  RC_ASSERT(fit(s).lateral <= fit(more).lateral);
  RC_ASSERT(fit(s).sum <= fit(more).sum);
  RC_ASSERT(fit(s).sagittal >= settings.weak_trigger.sagittal - 1e-12);
}

}  // namespace
}  // namespace poise
