// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/shift_height.h"

#include <gtest/gtest.h>

#include "poise/robot/control/posture/biped_fixture.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/sim/run.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

Robot Biped(double hip) {
  ArmsCase from;
  from.hip = hip;
  from.shoulder = 0.35;  // The arms hang clear of wide legs.
  return MakeStandingRobot(UrdfDocument(BipedText(from), "biped.urdf"));
}

TEST(SinkOfShift, IsZeroForRobotsWithHipsAndKneesToSpare) {
  EXPECT_EQ(SinkOfShift(LoadHumanoid(), 0, {0, 0}), 0);
  EXPECT_EQ(SinkOfShift(LoadHumanoid(), 1, {0, 0}), 0);
  EXPECT_EQ(SinkOfShift(Biped(0.1), 0, {0, 0}), 0);
}

// With its knees bent by 0.6 rad, the hips are 0.8 m cos(0.3) = 0.764 m above
// the ankles. From there, the straight leg of 0.8 m reaches 0.236 m aside, but
// the hips move by about 0.3 m.
TEST(SinkOfShift, IsPositiveForFeetFarApart) {
  const Robot robot = Biped(0.3);
  const double left = SinkOfShift(robot, 0, {0, 0});
  EXPECT_GT(left, 0.01);
  EXPECT_LT(left, 0.4);
  // Both sides agree by symmetry, within the search's tolerance, m.
  EXPECT_NEAR(SinkOfShift(robot, 1, {0, 0}), left, 1e-6);
}

TEST(SinkOfShift, IsZeroOutOfReach) {
  EXPECT_EQ(SinkOfShift(LoadHumanoid(), 0, {0, 3}), 0);
}

// Without the sink, the center of mass stays short of the foot, and the robot
// leans on the foot that it was told to lift.
TEST(SinkOfShift, LetsARobotWithFeetFarApartLiftAFoot) {
  Scenario scenario;
  scenario.duration = 5;
  StanceEvent shift;
  shift.at = 0.1;
  shift.foot = "left_foot";
  shift.over = 1.5;
  StanceEvent lift = shift;
  lift.kind = StanceEvent::Kind::kLift;
  lift.foot = "right_foot";
  lift.at = 2.1;
  lift.height = 0.05;
  scenario.stance = {shift, lift};
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {0, 1, 0};
  scenario.pushes[0].impulse_fraction = 0.05;
  scenario.pushes[0].start = 4;
  const RunResult result = poise::Run(Biped(0.4), scenario);
  EXPECT_FALSE(result.verdict.fell_at);
  EXPECT_TRUE(result.commanded_done.value_or(false));
}

}  // namespace
}  // namespace poise
