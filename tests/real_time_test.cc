// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <mutex>
#include <new>
#include <set>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/robot/control/estimator.h"
#include "poise/robot/control/measurement.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/scenario.h"
#include "poise/sim/sensors.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/forbidden_calls.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/scenario_files.h"

namespace poise {
namespace {

// Covers the push of each scenario and the reaction right after it.
constexpr double kDuration = 1.3;  // s.
// Longer than a weight shift, and than lifting or lowering a foot.
constexpr double kStanceTime = 1.5;  // s.

// Shortens a scenario: stance events follow each other every kStanceTime, and
// pushes start at 1 s at the latest. Returns the new duration [s].
double Hasten(Scenario* scenario) {
  double end = kDuration;
  for (size_t i = 1; i < scenario->stance.size(); ++i) {
    scenario->stance[i].at = scenario->stance[i - 1].at + kStanceTime;
    end = std::max(end, scenario->stance[i].at);
  }
  for (Push& push : scenario->pushes) push.start = std::min(push.start, 1.0);
  return end;
}

// Starts to lift or lower each foot that `leader` has just started to lift or
// lower.
void Follow(const Stance& leader, const Scenario& scenario, Stance* stance) {
  for (int foot = 0; foot < 2; ++foot) {
    if (leader.phase(foot) == stance->phase(foot)) continue;
    if (leader.phase(foot) == ContactPhase::kUnloading) {
      EXPECT_TRUE(stance->Lift(foot, scenario.stance[0].height));
    } else if (leader.phase(foot) == ContactPhase::kLanding) {
      stance->PutDown(foot);
    }
  }
}

class RealTimeTest : public testing::TestWithParam<std::string> {};

// A second controller runs on the same states as the one in the loop, and an
// estimator runs on simulated sensors. Forbidden calls are counted while these
// two update.
TEST_P(RealTimeTest, TheControlLoopNeitherAllocatesNorThrowsNorLocksNorWrites) {
  const Robot robot = LoadHumanoid();
  Scenario scenario = LoadScenario(GetParam());
  const double duration = Hasten(&scenario);
  ClosedLoop loop(robot, scenario);
  Controller controller(robot);
  const PlantState& truth = loop.plant().Sense();
  State state{truth.time, truth.q, truth.v};
  controller.Start(state);
  Sensors sensors(robot, scenario.sensors, scenario.seed);
  Estimator estimator(robot);
  estimator.Start(sensors.Measure(truth));
  State estimated = state;
  Command command;
  command.tau.setZero(robot.model.tree.num_joints());
  for (const std::string& task : scenario.control.without) {
    ASSERT_TRUE(controller.stack().Enable(task, false));
  }
  for (const std::string& task : scenario.control.with) {
    ASSERT_TRUE(controller.stack().Enable(task, true));
  }

  std::set<ContactPhase> phases;  // Phases of the lifted foot.
  while (loop.time() < duration) {
    state = {truth.time, truth.q, truth.v};
    const Measurement& measurement = sensors.Measure(truth);
    loop.Tick();
    controller.reference() = loop.controller().reference();
    Follow(loop.controller().stance(), scenario, &controller.stance());
    const CountMalloc count;
    const ForbiddenCalls forbidden;
    estimator.Update(measurement, &estimated);
    controller.Update(state, &command);
    ASSERT_EQ(count.allocations(), 0) << "at " << state.time << " s";
    ASSERT_EQ(forbidden.throws(), 0) << "at " << state.time << " s";
    ASSERT_EQ(forbidden.locks(), 0) << "at " << state.time << " s";
    ASSERT_EQ(forbidden.writes(), 0) << "at " << state.time << " s";
    ASSERT_TRUE(command.tau.allFinite());
    ASSERT_TRUE(estimated.q.allFinite() && estimated.v.allFinite());
    phases.insert(controller.stance().phase(1));
  }
  if (!scenario.stance.empty()) {
    for (const ContactPhase phase :
         {ContactPhase::kDown, ContactPhase::kUnloading, ContactPhase::kUp,
          ContactPhase::kLanding, ContactPhase::kLoading}) {
      EXPECT_EQ(phases.count(phase), 1u) << static_cast<int>(phase);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, RealTimeTest,
                         testing::ValuesIn(ScenarioFiles()), ScenarioTestName);

TEST(RealTime, FindsAllScenarioFiles) {
  EXPECT_EQ(ScenarioFiles().size(), kNumScenarios);
}

TEST(ForbiddenCalls, AreCounted) {
  if (!ForbiddenCalls::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  const ForbiddenCalls forbidden;
  EXPECT_EQ(forbidden.throws() + forbidden.locks() + forbidden.writes(), 0);
  try {
    throw std::runtime_error("a test of the test");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(forbidden.throws(), 1);
}

// Each locking or writing function is called alone, so that no counted function
// hides another that is not counted.
TEST(ForbiddenCalls, AreCountedForEachFunction) {
  if (!ForbiddenCalls::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  std::mutex mutex;
  std::shared_mutex shared;
  int number = 7;
  const std::vector<std::function<void()>> locks = {
      [&] { mutex.lock(), mutex.unlock(); },
      [&] { (void)mutex.try_lock(), mutex.unlock(); },
      [&] { shared.lock(), shared.unlock(); },
      [&] { shared.lock_shared(), shared.unlock_shared(); },
  };
  for (size_t i = 0; i < locks.size(); ++i) {
    const ForbiddenCalls forbidden;
    locks[i]();
    EXPECT_EQ(forbidden.locks(), 1) << i;
    EXPECT_EQ(forbidden.throws() + forbidden.writes(), 0) << i;
  }
  const std::vector<std::function<void()>> writes = {
      [&] { (void)!write(STDERR_FILENO, "\n", 1); },
      [&] { std::printf("%d\n", number); },
      [&] { std::fprintf(stderr, "%d\n", number); },
      [&] { std::puts("a line"); },
      [&] { std::fputs("a line\n", stderr); },
      [&] { std::cout << number << std::endl; },
      [&] { std::cerr << "a line\n"; },
  };
  for (size_t i = 0; i < writes.size(); ++i) {
    const ForbiddenCalls forbidden;
    writes[i]();
    EXPECT_GE(forbidden.writes(), 1) << i;
    EXPECT_EQ(forbidden.throws(), 0) << i;
  }
}

TEST(CountMalloc, CountsEachAllocationFunction) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  void* pointer = nullptr;
  const std::vector<std::function<void()>> ways = {
      [&] { pointer = std::malloc(8); },
      [&] { pointer = std::calloc(1, 8); },
      [&] { pointer = std::realloc(nullptr, 8); },
      [&] { pointer = std::aligned_alloc(64, 64); },
      [&] { ASSERT_EQ(posix_memalign(&pointer, 64, 64), 0); },
      [&] { pointer = ::operator new(8); },
      [&] { pointer = ::operator new(64, std::align_val_t(64)); },
  };
  for (size_t i = 0; i < ways.size(); ++i) {
    const CountMalloc count;
    ways[i]();
    EXPECT_EQ(count.allocations(), 1) << i;
    std::free(pointer);
  }
}

}  // namespace
}  // namespace poise
