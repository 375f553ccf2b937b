// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "robot/profile.h"
#include "sim/run.h"

namespace poise {
namespace {

// A case is a run of 0.6 s: a few will do, unless RC_PARAMS asks for more.
const bool kFewCases = [] {
  const char* given = std::getenv("RC_PARAMS");
  const std::string parameters = given != nullptr ? given : "";
  if (parameters.find("max_success") != parameters.npos) return false;
  return setenv("RC_PARAMS", (parameters + " max_success=8").c_str(), 1) == 0;
}();

const Robot& Humanoid() {
  static const Robot robot =
      LoadRobot("robot/models/humanoid.urdf",
                LoadProfile("robot/profiles/humanoid.yaml"));
  return robot;
}

// A push from anywhere, weak or far too strong, with sensors good or bad.
Scenario RandomScenario() {
  Scenario scenario;
  scenario.name = "fuzz";
  scenario.duration = 0.6;
  scenario.seed = *rc::gen::inRange<unsigned>(0, 1u << 30);
  scenario.start.joints = 0.01 * *rc::gen::inRange(0, 6);
  scenario.start.heading = 0.01 * *rc::gen::inRange(0, 628);
  Push push;
  const double angle = 0.01 * *rc::gen::inRange(0, 628);
  const double force = 10 * *rc::gen::inRange(0, 60);
  push.force = {force * std::cos(angle), force * std::sin(angle), 0};
  push.start = 0.1;
  push.duration = 0.01 * *rc::gen::inRange(1, 30);
  scenario.pushes = {push};
  scenario.control.delay = 1e-3 * *rc::gen::inRange(0, 4);
  scenario.control.mass_error = 0.01 * *rc::gen::inRange(-10, 11);
  scenario.sensors.noise = 0.1 * *rc::gen::inRange(0, 20);
  scenario.sensors.dropout = 0.01 * *rc::gen::inRange(0, 20);
  scenario.plant.friction = 0.1 * *rc::gen::inRange(2, 10);
  return scenario;
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");  // Or a last, empty one were lost.
  for (std::string cell; std::getline(stream, cell, ',');) {
    cells.push_back(cell);
  }
  return cells;
}

// What is wrong with a log: it must have a row a tick, and in each column but
// these last ones numbers only; but feet that bear nothing have no center of
// pressure.
std::string WrongWithLog(const std::filesystem::path& file, long ticks) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = Cells(line);
  const std::set<std::string> words = {"touching", "status", "active", "lost",
                                       "conflict"};
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
      if (std::isnan(number) && names[i].rfind("cop.", 0) == 0) continue;
      if (!is_number || !std::isfinite(number)) {
        return row + "'" + cells[i] + "' in " + names[i];
      }
    }
  }
  if (rows != ticks) return std::to_string(rows) + " rows";
  return "";
}

RC_GTEST_PROP(ClosedLoopFuzz, NoNumberIsLostAndNoTorqueLimitBroken, ()) {
  const Scenario scenario = RandomScenario();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "run";
  const RunResult result = Run(Humanoid(), scenario, folder);
  RC_ASSERT(result.ticks > 0);
  RC_ASSERT(WrongWithLog(folder / "log.csv", result.ticks) == "");
  RC_ASSERT(result.torque_limit_violation_peak <= 1e-6);
  // Solved to the last rank or not, what was solved is optimal.
  RC_ASSERT(result.certificate_max <= 1e-9 || result.failures > 0);
}

TEST(ClosedLoopFuzz, NoticesALogThatIsWrong) {
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
