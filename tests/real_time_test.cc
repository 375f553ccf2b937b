// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>

#include "robot/control/controller.h"
#include "robot/profile.h"
#include "sim/closed_loop.h"
#include "sim/scenario.h"
#include "tests/util/count_malloc.h"
#include "tests/util/forbidden_calls.h"

namespace poise {
namespace {

// Past the push of each scenario, and what follows at once.
constexpr double kDuration = 1.3;  // s.

std::vector<std::string> ScenarioFiles() {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::directory_iterator("sim/scenarios")) {
    files.push_back(entry.path().string());
  }
  return files;
}

class RealTimeTest : public testing::TestWithParam<std::string> {};

// A second controller sees what the one in the loop sees, and is watched.
TEST_P(RealTimeTest, TheControlLoopNeitherAllocatesNorThrowsNorLocksNorWrites) {
  const Robot robot = LoadRobot("robot/models/humanoid.urdf",
                                LoadProfile("robot/profiles/humanoid.yaml"));
  const Scenario scenario = LoadScenario(GetParam());
  ClosedLoop loop(robot, scenario);
  Controller controller(robot);
  const PlantState& truth = loop.plant().Sense();
  State state{truth.time, truth.q, truth.v};
  controller.Start(state);
  Command command;
  command.tau.setZero(robot.model.tree.num_joints());
  for (const std::string& task : scenario.control.without) {
    ASSERT_TRUE(controller.stack().Enable(task, false));
  }
  for (const std::string& task : scenario.control.with) {
    ASSERT_TRUE(controller.stack().Enable(task, true));
  }

  while (loop.time() < kDuration) {
    state = {truth.time, truth.q, truth.v};
    loop.Tick();
    controller.reference() = loop.controller().reference();
    const CountMalloc count;
    const ForbiddenCalls forbidden;
    controller.Update(state, &command);
    ASSERT_EQ(count.allocations(), 0) << "at " << state.time << " s";
    ASSERT_EQ(forbidden.throws(), 0) << "at " << state.time << " s";
    ASSERT_EQ(forbidden.locks(), 0) << "at " << state.time << " s";
    ASSERT_EQ(forbidden.writes(), 0) << "at " << state.time << " s";
    ASSERT_TRUE(command.tau.allFinite());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, RealTimeTest, testing::ValuesIn(ScenarioFiles()),
    [](const testing::TestParamInfo<std::string>& file) {
      return std::filesystem::path(file.param).stem().string();
    });

TEST(RealTime, HasScenariosToRun) { EXPECT_GE(ScenarioFiles().size(), 6u); }

TEST(ForbiddenCalls, AreSeen) {
  if (!ForbiddenCalls::IsSupported()) GTEST_SKIP() << "under a sanitizer";
  std::mutex mutex;
  const ForbiddenCalls forbidden;
  EXPECT_EQ(forbidden.throws() + forbidden.locks() + forbidden.writes(), 0);
  try {
    throw std::runtime_error("a test of the test");
  } catch (const std::runtime_error&) {
  }
  mutex.lock();
  mutex.unlock();
  (void)!write(STDERR_FILENO, "\n", 1);
  EXPECT_EQ(forbidden.throws(), 1);
  EXPECT_EQ(forbidden.locks(), 1);
  EXPECT_EQ(forbidden.writes(), 1);
}

}  // namespace
}  // namespace poise
