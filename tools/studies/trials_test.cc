// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/trials.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "poise/tests/util/load_humanoid.h"
#include "poise/tools/commands/push/push_options.h"

namespace poise {
namespace {

PushOptions ReadOptions(const std::string& options) {
  std::istringstream stream("push " + options);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return ReadPushOptions(static_cast<int>(argv.size()), argv.data());
}

void ExpectSame(const Scenario& a, const Scenario& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.control.dt, b.control.dt);
  EXPECT_EQ(a.control.delay, b.control.delay);
  EXPECT_EQ(a.control.mass_error, b.control.mass_error);
  EXPECT_EQ(a.control.estimator, b.control.estimator);
  EXPECT_EQ(a.control.tasks, b.control.tasks);
  EXPECT_EQ(a.control.with, b.control.with);
  EXPECT_EQ(a.control.without, b.control.without);
  EXPECT_EQ(a.plant.friction, b.plant.friction);
  EXPECT_EQ(a.plant.torque_scale, b.plant.torque_scale);
  EXPECT_EQ(a.sensors.noise, b.sensors.noise);
  EXPECT_EQ(a.sensors.freeze_at, b.sensors.freeze_at);
  EXPECT_EQ(a.sensors.freeze_for, b.sensors.freeze_for);
  ASSERT_EQ(a.pushes.size(), b.pushes.size());
  for (std::size_t i = 0; i < a.pushes.size(); ++i) {
    EXPECT_EQ(a.pushes[i].start, b.pushes[i].start);
    EXPECT_EQ(a.pushes[i].duration, b.pushes[i].duration);
    // The table prints six digits.
    EXPECT_TRUE(a.pushes[i].force.isApprox(b.pushes[i].force, 1e-5));
  }
}

// The table names the command that repeats each row.
TEST(RobustnessTrials, MatchTheExperimentsOfTheirOptions) {
  for (const Trial& trial : RobustnessTrials()) {
    SCOPED_TRACE(trial.what + ": " + trial.options);
    const PushOptions read = ReadOptions(trial.options);
    ExpectSame(trial.experiment.scenario, read.loop->scenario());
    EXPECT_EQ(trial.experiment.robot.q_nominal, read.loop->robot().q_nominal);
  }
}

// Every 13th trial has another error and another direction than the one before.
TEST(StepTrials, MatchTheExperimentsOfTheirOptions) {
  const std::vector<Trial> trials = StepTrials();
  EXPECT_EQ(trials.size(), 192u);
  for (std::size_t i = 0; i < trials.size(); i += 13) {
    SCOPED_TRACE(trials[i].what + ": " + trials[i].options);
    const PushOptions read = ReadOptions(trials[i].options);
    ExpectSame(trials[i].experiment.scenario, read.loop->scenario());
    EXPECT_TRUE(read.loop->scenario().steps);
    EXPECT_EQ(trials[i].experiment.scenario.plant_kind,
              read.loop->scenario().plant_kind);
  }
}

TEST(ToRow, DescribesARobotThatStaysUpButDoesNotReturn) {
  const Trial trial{"far off", {LoadHumanoid(), {}}, "--scenario stand"};
  EXPECT_EQ(
      ToRow(trial, {}),
      "| far off | `--scenario stand` | does not come back | 0.0, 0.0, "
      "0.0 | 0.00, 0.00, 0.00 | 0.0000 | 0.000, 0.000 | 0 | 0 | **no** |");
}

TEST(ToRow, PrintsViolationWithOneDigit) {
  TrialResult result;
  result.joint_violation = 2.1e-3;
  const std::string row = ToRow({"pushed", {LoadHumanoid(), {}}, ""}, result);
  EXPECT_NE(row.find("| 2e-03 |"), std::string::npos) << row;
}

}  // namespace
}  // namespace poise
