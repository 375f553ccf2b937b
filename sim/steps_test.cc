// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The robot steps if it has to, and only then.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "poise/sim/closed_loop.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

Scenario Shove(double impulse, double degrees) {
  Scenario scenario = LoadScenario("sim/scenarios/shove.yaml");
  scenario.duration = 5.3;
  Push& push = scenario.pushes[0];
  push.start = 0.3;
  const double a = degrees * M_PI / 180;
  push.force =
      impulse / push.duration * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
  return scenario;
}

// Impulses that no pendulum on two feet takes, see docs/steps.md. The robot
// ends square: the feet within 5 cm of side by side, the CoM at rest.
TEST(Steps, CatchShovesThatTheFeetAloneCannotTake) {
  struct Case {
    double degrees, impulse;
  };
  for (const auto& [degrees, impulse] :
       {Case{0, 45}, Case{90, 34}, Case{180, 45}, Case{-45, 40}}) {
    SCOPED_TRACE(degrees);
    ClosedLoop loop(Humanoid(), Shove(impulse, degrees));
    const RunResult result = poise::Run(&loop);
    EXPECT_TRUE(result.verdict.recovered);
    EXPECT_GE(result.steps.size(), 1u);
    EXPECT_GT(impulse, 1.4 * result.yardstick->lipm_Ns);
    EXPECT_EQ(result.failures, 0);
    EXPECT_LT(result.certificate_max, 1e-9);
    EXPECT_LT(result.verdict.com_error_final.norm(), 3e-3);
    const Pose& left = loop.observation().feet[0].X_WC;
    const Pose& right = loop.observation().feet[1].X_WC;
    const Eigen::Vector3d between = left.R.transpose() * (left.p - right.p);
    EXPECT_LT(std::abs(between.x()), 0.06);
    EXPECT_NEAR(between.y(), 0.157, 0.05);
  }
}

// 90 % of what the robot takes in place, docs/generated/push_map.md.
TEST(Steps, AreNotTakenIfTheFeetAloneSuffice) {
  struct Case {
    double degrees, in_place;
  };
  for (const auto& [degrees, in_place] :
       {Case{0, 18}, Case{45, 27}, Case{90, 25.25}, Case{180, 17}}) {
    SCOPED_TRACE(degrees);
    const RunResult result =
        poise::Run(Humanoid(), Shove(0.9 * in_place, degrees));
    EXPECT_TRUE(result.verdict.recovered);
    EXPECT_TRUE(result.steps.empty());
  }
}

TEST(Steps, AreNotTakenWithoutPermission) {
  Scenario scenario = Shove(40, 0);
  scenario.steps = false;
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_TRUE(result.steps.empty());
  EXPECT_FALSE(result.verdict.recovered);
}

TEST(Steps, GiveTheSameLogAgain) {
  const std::filesystem::path folder = testing::TempDir();
  Scenario scenario = Shove(34, 70);
  scenario.duration = 1.5;
  const std::string first =
      poise::Run(Humanoid(), scenario, folder / "first").log_sha256;
  EXPECT_EQ(poise::Run(Humanoid(), scenario, folder / "second").log_sha256,
            first);
}

// A commanded step lands softly at its place; one out of reach is refused, and
// the run says so.
TEST(Steps, FollowTheCommandsOfAScenario) {
  Scenario scenario = LoadScenario("sim/scenarios/stand.yaml");
  scenario.steps = true;
  scenario.duration = 4.5;
  StanceEvent step;
  step.kind = StanceEvent::Kind::kStep;
  step.at = 0.2;
  step.foot = Humanoid().feet[1].name;
  step.to = {-0.1, -0.12};
  scenario.stance = {step};
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_TRUE(result.verdict.recovered);
  EXPECT_EQ(result.commanded_done, true);
  ASSERT_EQ(result.steps.size(), 1u);
  EXPECT_LT(result.steps[0].impact_Ns, 0.5);
  EXPECT_LT(result.steps[0].slide, 1e-3);

  scenario.stance[0].to = {2, -0.12};
  scenario.duration = 1;
  const RunResult refused = poise::Run(Humanoid(), scenario);
  EXPECT_EQ(refused.commanded_done, false);
  EXPECT_EQ(refused.commanded[0].answer, StepAnswer::kOutOfReach);
  EXPECT_TRUE(refused.steps.empty());
}

// After the first step the feet belong to the gait: what the scenario wants of
// them is left out.
TEST(Steps, EndTheStanceOfTheScenario) {
  Scenario scenario = Shove(40, 0);
  StanceEvent lift;
  lift.kind = StanceEvent::Kind::kLift;
  lift.at = 3;
  lift.foot = Humanoid().feet[0].name;
  scenario.stance = {lift};
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_TRUE(result.verdict.recovered);
}

}  // namespace
}  // namespace poise
