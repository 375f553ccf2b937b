// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The robot steps if it has to, and only then.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

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

TEST(Steps, SayWhichCommandsDidNotHappen) {
  Scenario scenario = LoadScenario("sim/scenarios/stand.yaml");
  scenario.steps = true;
  scenario.duration = 1;
  StanceEvent step;
  step.kind = StanceEvent::Kind::kStep;
  step.at = 0.2;
  step.foot = Humanoid().feet[0].name;
  step.to = {0.1, 0.1};
  StanceEvent shift;
  shift.kind = StanceEvent::Kind::kShift;
  shift.at = 0.5;
  StanceEvent far = step, late = step;
  far.at = 0.6;
  late.at = 9;
  scenario.stance = {step, shift, far, late};
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_EQ(result.commanded_done, false);
  const std::string place = "step of left_foot to (0.1, 0.1) m at ";
  EXPECT_EQ(
      result.not_done,
      (std::vector<std::string>{
          place + "0.2 s: the foot did not land within 10 mm of its place",
          place + "0.6 s: refused, because the robot makes another step",
          place + "9 s: the run ended before",
          "shift at 0.5 s: from the first step on, the gait alone moves the "
          "CoM"}));
}

TEST(Steps, EndAMotionOfTheCenterOfMassAndSaySo) {
  Scenario scenario = LoadScenario("sim/scenarios/com_sinusoid.yaml");
  scenario.steps = true;
  scenario.duration = 0.5;
  StanceEvent step;
  step.kind = StanceEvent::Kind::kStep;
  step.at = 0;
  step.foot = Humanoid().feet[0].name;
  step.to = {0, 0.1};
  scenario.stance = {step};
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_EQ(result.commanded_done, false);
  EXPECT_EQ(result.not_done.back().rfind("motion of the CoM after 0 s", 0), 0u);
}

// The impact of a robot that lands is no push.
TEST(Steps, AreNotTakenAfterADrop) {
  Scenario scenario = LoadScenario("sim/scenarios/stand.yaml");
  scenario.steps = true;
  scenario.duration = 3;
  scenario.start.drop = 0.05;
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_TRUE(result.verdict.recovered);
  EXPECT_TRUE(result.steps.empty());
}

// A push while one foot is in the air for a commanded step.
TEST(Steps, CatchAPushDuringACommandedStep) {
  for (const double impulse : {10, 15, 20}) {
    SCOPED_TRACE(impulse);
    Scenario scenario = Shove(impulse, 90);
    scenario.pushes[0].start = 1.8;
    scenario.duration = 6;
    StanceEvent step;
    step.kind = StanceEvent::Kind::kStep;
    step.at = 0.2;
    step.foot = Humanoid().feet[0].name;
    step.to = {0.1, 0.1};
    scenario.stance = {step};
    const RunResult result = poise::Run(Humanoid(), scenario);
    EXPECT_TRUE(result.verdict.recovered);
    EXPECT_EQ(result.commanded_done, false);
  }
}

// After the first step the feet belong to the gait. The run reports each
// command that is left out.
TEST(Steps, EndTheStanceOfTheScenarioAndSaySo) {
  Scenario scenario = Shove(40, 0);
  StanceEvent lift;
  lift.kind = StanceEvent::Kind::kLift;
  lift.at = 3;
  lift.foot = Humanoid().feet[0].name;
  StanceEvent put_down = lift;
  put_down.kind = StanceEvent::Kind::kPutDown;
  put_down.at = 3.5;
  scenario.stance = {lift, put_down};
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_TRUE(result.verdict.recovered);
  EXPECT_EQ(result.commanded_done, false);
  for (const std::string what :
       {"lift of left_foot at 3", "put_down of left_foot at 3.5"}) {
    const std::string message =
        what + " s: from the first step on, the gait alone moves the feet";
    EXPECT_EQ(
        std::count(result.not_done.begin(), result.not_done.end(), message), 1)
        << what;
  }
}

}  // namespace
}  // namespace poise
