// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/push_bound.h"

#include <gtest/gtest.h>

#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

Push PushTo(double x, double y) {
  Push push;
  push.force = {x, y, 0};
  return push;
}

TEST(ApplyFraction, GivesTheFractionOfTheBound) {
  const Robot robot = LoadHumanoid();
  for (const PushProfile profile :
       {PushProfile::kBox, PushProfile::kHalfSine, PushProfile::kImpulse}) {
    Push push = PushTo(3, 4);
    push.profile = profile;
    push.impulse_fraction = 0.4;
    EXPECT_TRUE(ApplyFraction(robot, robot.q_nominal, {}, push.force, &push));
    const auto bound = BoundOfPush(robot, robot.q_nominal, push);
    ASSERT_TRUE(bound);
    // Rounding of numbers of some 10 N s.
    EXPECT_NEAR(ImpulseOf(push), 0.4 * bound->lipm_height_Ns, 1e-12);
    EXPECT_NEAR(push.force.x() * 4, push.force.y() * 3, 1e-10);
  }
}

TEST(ApplyFraction, UsesTheFeetThatAreDown) {
  const Robot robot = LoadHumanoid();
  Push both = PushTo(0, -1), left = both;
  both.impulse_fraction = left.impulse_fraction = 0.5;
  const Eigen::Vector3d direction = both.force;
  EXPECT_TRUE(
      ApplyFraction(robot, robot.q_nominal, {true, true}, direction, &both));
  EXPECT_GT(both.force.norm(), 10);
  // The CoM amid the feet is outside of the left sole.
  EXPECT_FALSE(
      ApplyFraction(robot, robot.q_nominal, {true, false}, direction, &left));
  EXPECT_EQ(left.force.norm(), 0);
  // A later bound above 0 gives the push its force.
  EXPECT_TRUE(
      ApplyFraction(robot, robot.q_nominal, {true, true}, direction, &left));
  EXPECT_EQ(left.force, both.force);
}

TEST(ApplyFraction, AcceptsAFractionOfZero) {
  const Robot robot = LoadHumanoid();
  Push push = PushTo(0, 100);
  push.impulse_fraction = 0;
  EXPECT_TRUE(ApplyFraction(robot, robot.q_nominal, {}, push.force, &push));
  EXPECT_EQ(push.force.norm(), 0);
}

TEST(ApplyFraction, GivesNoForceBelowTheSoles) {
  const Robot robot = LoadHumanoid();
  for (const double z : {-2.0, -10.0}) {
    Push push = PushTo(0, 100);
    push.point = Eigen::Vector3d(0, 0, z);
    push.impulse_fraction = 0.5;
    EXPECT_FALSE(ApplyFraction(robot, robot.q_nominal, {}, push.force, &push));
    EXPECT_EQ(push.force.norm(), 0);
    EXPECT_FALSE(BoundOfPush(robot, robot.q_nominal, push));
  }
}

TEST(ApplyFraction, LeavesAPushInNewtons) {
  const Robot robot = LoadHumanoid();
  Push push = PushTo(0, 100);
  EXPECT_TRUE(ApplyFraction(robot, robot.q_nominal, {}, {1, 0, 0}, &push));
  EXPECT_EQ(push.force, Eigen::Vector3d(0, 100, 0));
}

TEST(HasBegun, CountsAPushFromTheTickInWhichItActs) {
  Push push;
  push.start = 0.1;
  EXPECT_FALSE(HasBegun(push, 0.098, 1e-3));
  EXPECT_FALSE(HasBegun(push, 0.099, 1e-3));  // Begins with the next tick.
  EXPECT_TRUE(HasBegun(push, 0.1, 1e-3));
  push.start = 0.0996;
  EXPECT_TRUE(HasBegun(push, 0.099, 1e-3));
}

TEST(BoundOfPush, NeedsAHorizontalDirectionInTheWorld) {
  const Robot robot = LoadHumanoid();
  Push push = PushTo(0, 100);
  EXPECT_TRUE(BoundOfPush(robot, robot.q_nominal, push));
  push.frame = PushFrame::kLink;
  EXPECT_FALSE(BoundOfPush(robot, robot.q_nominal, push));
  push = PushTo(0, 0);
  push.force.z() = 10;
  EXPECT_FALSE(BoundOfPush(robot, robot.q_nominal, push));
}

}  // namespace
}  // namespace poise
