// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/experiment.h"

#include <gtest/gtest.h>

#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

TEST(Experiment, TakesTheTasksOfTheProfileInsteadOfTheDefault) {
  const Profile profile =
      LoadProfile(TestFile("own.yaml", "tasks: {yaw: off}\n"));
  Scenario scenario;
  UseTasksOf(profile, &scenario);
  EXPECT_EQ(scenario.control.tasks, profile.file.string());
  scenario.control.tasks = "paper";
  UseTasksOf(profile, &scenario);
  EXPECT_EQ(scenario.control.tasks, "paper");
}

TEST(Experiment, KeepsTheDefaultTasksWithoutTasksInTheProfile) {
  Scenario scenario;
  UseTasksOf({}, &scenario);
  EXPECT_EQ(scenario.control.tasks, "default");
}

TEST(Experiment, LoadsARobotThatStands) {
  const Experiment experiment = LoadExperiment(
      "robot/models/humanoid.urdf", LoadProfile("robot/profiles/humanoid.yaml"),
      LoadScenario("sim/scenarios/stand.yaml"));
  EXPECT_TRUE(experiment.robot.can_stand);
  EXPECT_EQ(experiment.scenario.name, "stand");
}

}  // namespace
}  // namespace poise
