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

// Past the push of each scenario, and what follows at once.
constexpr double kDuration = 1.3;  // s.
// A shift of the weight, a foot's way up or down take less.
constexpr double kStanceTime = 1.5;  // s.

// The scenario in a short time: what it does with the feet follows at once.
double Hasten(Scenario* scenario) {
  double end = kDuration;
  for (size_t i = 1; i < scenario->stance.size(); ++i) {
    scenario->stance[i].at = scenario->stance[i - 1].at + kStanceTime;
    end = std::max(end, scenario->stance[i].at);
  }
  for (Push& push : scenario->pushes) push.start = std::min(push.start, 1.0);
  return end;
}

// Lifts and puts down the feet that another stance begins to.
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

// A second controller sees what the one in the loop sees, and is watched; so is
// what estimates the base, of what a robot's sensors say.
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

  std::set<ContactPhase> phases;  // Of the foot that is lifted.
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

TEST(RealTime, HasAllScenariosToRun) {
  EXPECT_EQ(ScenarioFiles().size(), kNumScenarios);
}

TEST(ForbiddenCalls, AreSeen) {
  if (!ForbiddenCalls::IsSupported()) GTEST_SKIP() << "under a sanitizer";
  const ForbiddenCalls forbidden;
  EXPECT_EQ(forbidden.throws() + forbidden.locks() + forbidden.writes(), 0);
  try {
    throw std::runtime_error("a test of the test");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(forbidden.throws(), 1);
}

// Each way to lock or write by itself: none hides behind another.
TEST(ForbiddenCalls, AreSeenInEachWay) {
  if (!ForbiddenCalls::IsSupported()) GTEST_SKIP() << "under a sanitizer";
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

TEST(CountMalloc, SeesEachWay) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "under a sanitizer";
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
