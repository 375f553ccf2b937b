// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/command_watch.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "poise/robot/control/stance.h"
#include "poise/sim/observation.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// The CoM moves over the left foot, the right foot is lifted and put down.
Scenario OneLeg() {
  Scenario scenario;
  scenario.name = "one_leg";
  scenario.duration = 4.6;
  StanceEvent shift;
  shift.at = 0.1;
  shift.foot = "left_foot";
  shift.over = 1;
  StanceEvent lift = shift, put_down = shift;
  lift.kind = StanceEvent::Kind::kLift;
  lift.foot = put_down.foot = "right_foot";
  lift.at = 1.4;
  put_down.kind = StanceEvent::Kind::kPutDown;
  put_down.at = 2.8;
  scenario.stance = {shift, lift, put_down};
  return scenario;
}

// Returns the humanoid with this dry friction in each joint, N m.
Robot WithFriction(double friction) {
  Robot robot = LoadHumanoid();
  for (JointLimits& limits : robot.model.limits) limits.friction = friction;
  return robot;
}

TEST(CommandWatch, SeesThatTheMotionHappens) {
  const RunResult result = poise::Run(LoadHumanoid(), OneLeg());
  EXPECT_TRUE(result.verdict.recovered);
  EXPECT_EQ(result.commanded_done, true);
  EXPECT_TRUE(result.not_done.empty());
}

// The friction is larger than the torque of any motor. The sole of the foot
// that is to be put down is on the ground all the time.
TEST(CommandWatch, SeesThatFrictionHoldsTheRobot) {
  const RunResult result = poise::Run(WithFriction(2000), OneLeg());
  EXPECT_FALSE(result.verdict.fell_at);
  EXPECT_EQ(result.commanded_done, false);
  ASSERT_EQ(result.not_done.size(), 2u);
  EXPECT_EQ(result.not_done[0].rfind("shift to left_foot at 0.1 s: the CoM", 0),
            0u)
      << result.not_done[0];
  EXPECT_EQ(
      result.not_done[1].rfind("lift of right_foot at 1.4 s: the sole rose", 0),
      0u)
      << result.not_done[1];
}

// The compensation of the friction moves the robot.
TEST(CommandWatch, SeesThatCompensatedFrictionDoesNotHoldTheRobot) {
  Scenario scenario = OneLeg();
  scenario.stance.resize(1);
  scenario.duration = 2;
  constexpr double kFriction = 10;  // N m.
  const RunResult result = poise::Run(WithFriction(kFriction), scenario);
  EXPECT_TRUE(result.verdict.recovered);
  EXPECT_EQ(result.commanded_done, true);
  // Without compensation, this friction holds the robot.
  scenario.control.drag_compensation = false;
  EXPECT_EQ(poise::Run(WithFriction(kFriction), scenario).commanded_done,
            false);
}

// Returns whether a watch accepts a motion of the CoM as a command along x of
// 0.05 m sin(2 pi t / 3 s).
bool Accepts(const std::function<Eigen::Vector3d(double phase)>& motion) {
  Scenario scenario;
  scenario.com.sine = {0.05, 0, 0};
  scenario.com.period = 3;
  CommandWatch watch(LoadHumanoid(), scenario, StanceSettings());
  const double end = 6;
  for (double time = 0; time < end; time += 1e-3) {
    const double phase = 2 * M_PI * time / scenario.com.period;
    Observation now;
    now.time = time;
    now.com_ref = {0.05 * std::sin(phase), 0, 0};
    now.com = motion(phase);
    watch.Look(now);
  }
  EXPECT_TRUE(watch.has_command(end));
  return watch.Missed(end).empty();
}

TEST(CommandWatch, ComparesTheDirectionAndTheFrequencyOfTheMotion) {
  const auto along = [](double size, double lag, double rate) {
    return Accepts([=](double phase) {
      return Eigen::Vector3d(
          size * (std::sin(rate * phase - lag) + std::sin(lag)), 0, 0);
    });
  };
  EXPECT_TRUE(along(0.05, 0, 1));
  EXPECT_TRUE(along(0.03, 0, 1));
  EXPECT_FALSE(along(0.02, 0, 1));
  EXPECT_TRUE(along(0.05, 1, 1));          // Lags behind.
  EXPECT_FALSE(along(0.05, M_PI, 1));      // Moves the other way.
  EXPECT_FALSE(along(0.05, 0, 3));         // Shakes.
  EXPECT_FALSE(Accepts([](double phase) {  // Moves to the side.
    return Eigen::Vector3d(0, 0.05 * std::sin(phase), 0);
  }));
}

TEST(CommandWatch, SeesThatTheCenterOfMassDoesNotFollow) {
  Scenario scenario;
  scenario.name = "sinusoid";
  scenario.duration = 1.5;
  scenario.com.sine = {0.05, 0, 0};
  scenario.com.period = 3;
  EXPECT_EQ(poise::Run(LoadHumanoid(), scenario).commanded_done, true);
  const RunResult held = poise::Run(WithFriction(2000), scenario);
  EXPECT_EQ(held.commanded_done, false);
  EXPECT_EQ(held.not_done.size(), 1u);
}

TEST(CommandWatch, DoesNotJudgeACommandThatTheRunCutsShort) {
  Scenario scenario = OneLeg();
  scenario.duration = 1;  // The shift ends at 1.1 s.
  EXPECT_EQ(poise::Run(LoadHumanoid(), scenario).commanded_done, std::nullopt);
  scenario.stance.clear();
  EXPECT_EQ(poise::Run(LoadHumanoid(), scenario).commanded_done, std::nullopt);
}

}  // namespace
}  // namespace poise
