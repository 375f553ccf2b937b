// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/fit_to_robot.h"

#include <gtest/gtest.h>

#include <string>

#include "poise/sim/observation.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

Scenario Load(const std::string& name) {
  return LoadScenario("sim/scenarios/" + name + ".yaml");
}

// Returns the humanoid with all masses multiplied.
Robot Heavier(double factor) {
  Robot robot = LoadHumanoid();
  robot.model.tree = robot.model.tree.WithScaledInertias(factor);
  return robot;
}

TEST(FitToRobot, KeepsNewtonsAndLengthsOnTheChosenRobot) {
  const Robot robot = LoadHumanoid();
  for (const char* name :
       {"posture_off", "weak_push", "strong_push", "strong_push_without_zmp",
        "one_leg", "slope", "board", "shove", "stand", "com_sinusoid"}) {
    SCOPED_TRACE(name);
    const Scenario written = Load(name);
    ASSERT_TRUE(written.chosen_for);
    const Scenario fitted = FitToRobot(robot, written);
    EXPECT_EQ(fitted.com.sine, written.com.sine);
    EXPECT_EQ(fitted.start.drop, written.start.drop);
    for (std::size_t i = 0; i < written.pushes.size(); ++i) {
      EXPECT_TRUE(written.pushes[i].elsewhere);
      EXPECT_FALSE(fitted.pushes[i].impulse_fraction);
      EXPECT_EQ(fitted.pushes[i].force, written.pushes[i].force);
    }
  }
}

TEST(FitToRobot, UsesTheFractionOnARobotOfAnotherMass) {
  const Scenario written = Load("strong_push");
  const Scenario fitted = FitToRobot(Heavier(1.02), written);
  EXPECT_EQ(fitted.pushes[0].impulse_fraction, written.pushes[0].elsewhere);
  EXPECT_FALSE(fitted.pushes[0].elsewhere);
  EXPECT_FALSE(FitToRobot(Heavier(1.005), written).pushes[0].impulse_fraction);
}

TEST(FitToRobot, ScalesLengthsWithTheHeight) {
  const Robot robot = LoadHumanoid();
  Scenario scenario = Load("board");
  scenario.chosen_for->com_height = StandingHeight(robot) / 0.3;
  scenario.com.cosine = {0, 0.1, 0};
  scenario.stance.emplace_back();
  scenario.stance[0].height = 0.1;
  const Scenario fitted = FitToRobot(robot, scenario);
  constexpr double kRounding = 1e-15;  // A few roundings of numbers below 1.
  EXPECT_NEAR(fitted.start.drop, 0.3 * scenario.start.drop, kRounding);
  EXPECT_NEAR(fitted.com.cosine.y(), 0.03, kRounding);
  EXPECT_NEAR(fitted.stance[0].height, 0.03, kRounding);
  const Board& board = scenario.plant.ground.boards[0];
  const Board& scaled = fitted.plant.ground.boards[0];
  EXPECT_TRUE(scaled.size.isApprox(0.3 * board.size, kRounding));
  EXPECT_TRUE(scaled.center_W.isApprox(0.3 * board.center_W, kRounding));
}

TEST(FitToRobot, ChangesNothingTheSecondTime) {
  const Robot robot = Heavier(2);
  const Scenario once = FitToRobot(robot, Load("com_sinusoid"));
  const Scenario twice = FitToRobot(robot, once);
  EXPECT_EQ(twice.com.sine, once.com.sine);
  EXPECT_EQ(twice.com.cosine, once.com.cosine);
}

// A scenario of a user says nothing of a robot.
TEST(FitToRobot, LeavesAScenarioWithoutAChosenRobot) {
  Scenario scenario;
  scenario.com.sine = {0.1, 0, 0};
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {0, 50, 0};
  const Scenario fitted = FitToRobot(Heavier(3), scenario);
  EXPECT_EQ(fitted.com.sine, scenario.com.sine);
  EXPECT_EQ(fitted.pushes[0].force, scenario.pushes[0].force);
  EXPECT_FALSE(fitted.pushes[0].impulse_fraction);
}

}  // namespace
}  // namespace poise
