// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/closed_loop.h"

#include <gtest/gtest.h>

#include "poise/robot/input_error.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

Push Sideways() {
  Push push;
  push.force = {0, 100, 0};
  push.start = 0.02;
  push.duration = 0.02;
  return push;
}

// Returns q after 50 ticks.
Eigen::VectorXd Simulate(ClosedLoop* loop) {
  for (int i = 0; i < 50; ++i) loop->Tick();
  return loop->plant().Sense().q;
}

TEST(ClosedLoop, AddedPushIsThatOfTheScenario) {
  const Robot robot = LoadHumanoid();
  Scenario pushed;
  pushed.pushes = {Sideways()};
  ClosedLoop expected(robot, pushed);
  ClosedLoop loop(robot, {});
  loop.AddPush(Sideways());
  const Eigen::VectorXd q = Simulate(&loop);
  EXPECT_EQ(q, Simulate(&expected));
  ClosedLoop still(robot, {});
  EXPECT_NE(q, Simulate(&still));
}

TEST(ClosedLoop, AddedPushActsFromNowOn) {
  const Robot robot = LoadHumanoid();
  ClosedLoop loop(robot, {}), still(robot, {});
  EXPECT_EQ(Simulate(&loop), Simulate(&still));
  Push push = Sideways();
  push.start = loop.time();
  loop.AddPush(push);
  EXPECT_GT(Simulate(&loop)[1], Simulate(&still)[1]);
}

TEST(ClosedLoop, AddsAFractionOfTheBound) {
  const Robot robot = LoadHumanoid();
  Scenario pushed;
  Push push = Sideways();
  push.impulse_fraction = 0.3;
  pushed.pushes = {push};
  ClosedLoop expected(robot, pushed), loop(robot, {});
  loop.AddPush(push);
  EXPECT_EQ(Simulate(&loop), Simulate(&expected));
}

TEST(ClosedLoop, RejectsAnAddedPushOnAnUnknownLink) {
  ClosedLoop loop(LoadHumanoid(), {});
  Push push = Sideways();
  push.link = "nose";
  EXPECT_THROW(loop.AddPush(push), InputError);
  push.link = "";
  push.duration = -1;
  EXPECT_THROW(loop.AddPush(push), InputError);
  EXPECT_TRUE(loop.scenario().pushes.empty());
}

}  // namespace
}  // namespace poise
