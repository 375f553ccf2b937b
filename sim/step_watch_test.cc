// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/step_watch.h"

#include <gtest/gtest.h>

#include "poise/sim/closed_loop.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// A step on command, and what the watch must say about it.
TEST(StepWatch, RecordsAStepOnCommand) {
  const Robot robot = LoadHumanoid();
  Scenario scenario;
  scenario.name = "step";
  scenario.duration = 4;
  scenario.steps = true;
  StanceEvent command;
  command.kind = StanceEvent::Kind::kStep;
  command.at = 0.2;
  command.foot = robot.feet[0].name;
  command.to = {0.12, 0.1};
  scenario.stance = {command};
  ClosedLoop loop(robot, scenario);
  StepWatch watch;
  double lift_off = -1, landing = -1, highest_load = 0;
  bool was_stepping = false;
  while (loop.time() < scenario.duration) {
    loop.Tick();
    const TickRecord record = loop.record();
    watch.Look(record);
    const bool steps = record.stance.phase(0) == ContactPhase::kStepping;
    if (steps && !was_stepping) lift_off = record.observation.time;
    if (!steps && was_stepping) landing = record.observation.time;
    if (landing > 0 && record.observation.time < landing + 0.01) {
      highest_load =
          std::max(highest_load, record.observation.feet[0].F_Co_C[5]);
    }
    was_stepping = steps;
  }
  ASSERT_EQ(loop.commanded().size(), 1u);
  EXPECT_EQ(loop.commanded()[0].answer, StepAnswer::kAccepted);
  ASSERT_EQ(watch.steps().size(), 1u);
  const TakenStep& step = watch.steps()[0];
  EXPECT_EQ(step.foot, 0);
  EXPECT_TRUE(step.is_commanded);
  EXPECT_TRUE(step.has_landed);
  EXPECT_EQ(step.at, lift_off);
  EXPECT_NEAR(step.swing_time, landing - lift_off, 1e-9);
  EXPECT_EQ(step.planned, command.to);
  EXPECT_LT((step.landed - command.to).norm(), 0.01);
  EXPECT_LT(step.touchdown_speed, 0.1);
  EXPECT_GT(step.impact_Ns, 0);
  EXPECT_LT(step.impact_Ns, 0.01 * highest_load);  // 10 ms of the peak.
  EXPECT_LT(step.slide, 1e-3);
}

TEST(StepWatch, RecordsNothingIfNoFootSteps) {
  ClosedLoop loop(LoadHumanoid(), LoadScenario("sim/scenarios/stand.yaml"));
  StepWatch watch;
  for (int i = 0; i < 50; ++i) {
    loop.Tick();
    watch.Look(loop.record());
  }
  EXPECT_TRUE(watch.steps().empty());
}

}  // namespace
}  // namespace poise
