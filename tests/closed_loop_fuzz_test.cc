// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "poise/sim/run.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Each case simulates 0.6 s, so 8 cases are the default. RC_PARAMS may set
// another max_success.
const bool kFewCases = [] {
  const char* given = std::getenv("RC_PARAMS");
  const std::string parameters = given != nullptr ? given : "";
  if (parameters.find("max_success") != parameters.npos) return false;
  return setenv("RC_PARAMS", (parameters + " max_success=8").c_str(), 1) == 0;
}();

const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

// Draws a push from any direction, mild or far too strong, and sensors of any
// quality.
Scenario RandomScenario() {
  Scenario scenario;
  scenario.name = "fuzz";
  scenario.duration = 0.6;
  scenario.seed = *rc::gen::inRange<unsigned>(0, 1u << 30);
  scenario.start.joints = 0.01 * *rc::gen::inRange(0, 6);
  scenario.start.heading = 0.01 * *rc::gen::inRange(0, 628);
  Push push;
  const double angle = 0.01 * *rc::gen::inRange(0, 628);
  const bool strong = *rc::gen::element(false, true);
  const double force = (strong ? 10 : 1) * *rc::gen::inRange(0, 60);
  push.force = {force * std::cos(angle), force * std::sin(angle), 0};
  push.start = 0.1;
  push.duration = 0.01 * *rc::gen::inRange(1, 30);
  scenario.pushes = {push};
  scenario.control.delay = 1e-3 * *rc::gen::inRange(0, 4);
  scenario.control.mass_error = 0.01 * *rc::gen::inRange(-10, 11);
  scenario.sensors.noise = 0.1 * *rc::gen::inRange(0, 20);
  scenario.sensors.dropout = 0.01 * *rc::gen::inRange(0, 20);
  // The plant has joint stops only for strong pushes. After a mild push the
  // controller alone must keep the joint limits.
  scenario.plant.joint_limits = strong;
  scenario.plant.torque_scale = 1 - 0.1 * *rc::gen::inRange(0, 6);
  scenario.plant.friction = 0.1 * *rc::gen::inRange(2, 10);
  return scenario;
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");  // Keeps an empty last cell.
  for (std::string cell; std::getline(stream, cell, ',');) {
    cells.push_back(cell);
  }
  return cells;
}

// Describes the first fault of a log file, or returns "". The log must have one
// row per tick. Each cell must be a finite number, except in the columns of
// words. The center of pressure may be NaN: it is undefined while the feet
// carry no load. So may the planned step while the robot does not step. A gap
// may be infinite, or NaN in a tick that fails safe.
std::string WrongWithLog(const std::filesystem::path& file, long ticks) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = Cells(line);
  const std::set<std::string> words = {
      "touching", "status", "active",          "lost",
      "conflict", "reason", "left_foot.phase", "right_foot.phase"};
  long rows = 0;
  for (; std::getline(stream, line); ++rows) {
    const std::vector<std::string> cells = Cells(line);
    const std::string row = "row " + std::to_string(rows) + " has ";
    if (cells.size() != names.size()) {
      return row + std::to_string(cells.size()) + " cells";
    }
    for (size_t i = 0; i < cells.size(); ++i) {
      if (words.count(names[i]) > 0) continue;
      char* end;
      const double number = std::strtod(cells[i].c_str(), &end);
      const bool is_number = !cells[i].empty() && *end == 0;
      const bool may_be_nan =
          names[i].rfind("cop.", 0) == 0 || names[i].rfind("plan.", 0) == 0;
      if (std::isnan(number) && may_be_nan) continue;
      const bool is_gap = names[i].rfind("gap.", 0) == 0;
      if (is_gap && is_number && !(number < 0)) continue;
      if (!is_number || !std::isfinite(number)) {
        return row + "'" + cells[i] + "' in " + names[i];
      }
    }
  }
  if (rows != ticks) return std::to_string(rows) + " rows";
  return "";
}

// Returns the humanoid with joint limits at most `room` [rad] from its nominal
// posture. The room is only a little larger than the motion after a push, so
// that the limits become active.
Robot HumanoidWithRoom(double room) {
  Robot robot = Humanoid();
  for (int j = 0; j < robot.model.tree.num_joints(); ++j) {
    const double q = robot.q_nominal[robot.model.tree.q_start() + j];
    JointLimits& limits = robot.model.limits[j];
    limits.lower = std::max(limits.lower, q - room);
    limits.upper = std::min(limits.upper, q + room);
  }
  return robot;
}

// Returns whether the push has at most kMild of the impulse that a linear
// inverted pendulum on the same feet can take. From about 0.8 of that impulse
// on, the arms swing with full torque. Their jolts throw the fingers, which
// weigh a few grams, past their stops, sometimes by more than 0.01 rad. A
// falling robot can exceed any joint limit.
bool IsMild(const RunResult& result) {
  constexpr double kMild = 0.6;
  return !result.yardstick ||
         result.impulse_Ns <= kMild * result.yardstick->lipm_height_Ns;
}

RC_GTEST_PROP(ClosedLoopFuzz, LogIsCompleteAndLimitsHold, ()) {
  const Scenario scenario = RandomScenario();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "run";
  const double room = 0.01 * (40 - *rc::gen::inRange(0, 26));
  const RunResult result = Run(HumanoidWithRoom(room), scenario, folder);
  RC_ASSERT(result.ticks > 0);
  RC_ASSERT(WrongWithLog(folder / "log.csv", result.ticks) == "");
  // In a tick that was not solved to the last level, the certificate covers the
  // solved levels only.
  RC_ASSERT(result.certificate_max <= 1e-9);
  // Torques are clamped to their limits, so the limits hold to the last bit.
  RC_ASSERT(result.torque_limit_violation_peak <= 0);
  // The controller keeps joints 8 mrad off their limits. This margin covers the
  // errors of its sensors and its model: no true joint angle may exceed a
  // limit.
  RC_ASSERT(!IsMild(result) || result.joint_limit_violation_peak <= 1e-6);
}

TEST(ClosedLoopFuzz, DetectsJointBeyondItsLimit) {
  Scenario scenario;
  scenario.duration = 0.6;
  scenario.plant.joint_limits = false;
  Push push;
  push.force = {0, 60, 0};
  push.start = 0.1;
  push.duration = 0.15;
  scenario.pushes = {push};
  const Robot robot = HumanoidWithRoom(0.1);
  const RunResult kept = poise::Run(robot, scenario);
  EXPECT_TRUE(IsMild(kept));
  EXPECT_LE(kept.joint_limit_violation_peak, 1e-6);
  scenario.control.without = {"joint_limits"};
  EXPECT_GT(poise::Run(robot, scenario).joint_limit_violation_peak, 1e-3);
}

TEST(ClosedLoopFuzz, DetectsInvalidLog) {
  (void)kFewCases;
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "log.csv";
  std::ofstream(file) << "time[s],q.a[rad]\n0,1\n1,2\n";
  EXPECT_EQ(WrongWithLog(file, 2), "");
  EXPECT_EQ(WrongWithLog(file, 3), "2 rows");
  std::ofstream(file) << "time[s],q.a[rad]\n0,nan\n";
  EXPECT_EQ(WrongWithLog(file, 1), "row 0 has 'nan' in q.a[rad]");
  std::ofstream(file) << "time[s],q.a[rad]\n0,1x\n";
  EXPECT_EQ(WrongWithLog(file, 1), "row 0 has '1x' in q.a[rad]");
  std::ofstream(file) << "time[s],q.a[rad]\n0\n";
  EXPECT_EQ(WrongWithLog(file, 1), "row 0 has 1 cells");
  std::ofstream(file) << "cop.x[m]\nnan\n";
  EXPECT_EQ(WrongWithLog(file, 1), "");
  std::ofstream(file) << "cop.x[m]\n0\n-inf\n";
  EXPECT_EQ(WrongWithLog(file, 2), "row 1 has '-inf' in cop.x[m]");
}

}  // namespace
}  // namespace poise
