// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Simulates a minute of pushes and replays its states 17 times: a million ticks
// of the controller. The test prints the times of the ticks and checks that no
// tick allocates memory.
//   bazel test --config=opt --test_output=all //tests:million_ticks_test
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/quantile.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr double kMinute = 60;        // s.
constexpr double kBetweenPushes = 3;  // s.
constexpr int kTimed = 5;             // Timed rounds; the fastest counts.
constexpr int kRounds = 17;           // Each of 60,000 ticks.
constexpr double kFullTurns = 7;      // Push direction, within the minute.

// Pushes from all directions, with up to two thirds of the force that the robot
// can take.
Scenario Pushes() {
  Scenario scenario = LoadScenario("sim/scenarios/stand.yaml");
  scenario.duration = kMinute;
  for (double at = 1; at < kMinute; at += kBetweenPushes) {
    const double angle = 2 * M_PI * kFullTurns * at / kMinute;
    Push push;
    push.start = at;
    push.duration = 0.1;
    push.force =
        (50 + at) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    scenario.pushes.push_back(push);
  }
  return scenario;
}

void Print(const char* what, std::vector<double> us) {
  const double median = Quantile(&us, 0.5), largest = Quantile(&us, 1);
  const double p999 = Quantile(&us, 0.999);
  std::printf(
      "%s: median %.1f us, p99 %.1f, p99.9 %.1f, max %.1f; "
      "p99.9 / median %.1f, max / median %.1f\n",
      what, median, Quantile(&us, 0.99), p999, largest, p999 / median,
      largest / median);
}

TEST(MillionTicks, DoNotAllocate) {
  using Clock = std::chrono::steady_clock;
  const Robot robot = LoadHumanoid();
  const Scenario scenario = Pushes();
  std::vector<State> states;
  {
    ClosedLoop loop(robot, scenario);
    while (loop.time() < kMinute - scenario.control.dt / 2) {
      const PlantState& truth = loop.plant().Sense();
      states.push_back({truth.time, truth.q, truth.v});
      loop.Tick();
    }
  }
  Command command;
  command.tau.setZero(robot.model.tree.num_joints());
  std::vector<double> fastest(states.size(),
                              std::numeric_limits<double>::infinity());
  std::vector<double> raw;
  raw.reserve(kTimed * states.size());
  long ticks = 0, allocations = 0, not_solved = 0;
  for (int round = 0; round < kRounds; ++round) {
    Controller controller(robot);
    controller.Start(states[0]);
    for (size_t k = 0; k < states.size(); ++k) {
      const CountMalloc count;
      const auto before = Clock::now();
      controller.Update(states[k], &command);
      const double us =
          std::chrono::duration<double, std::micro>(Clock::now() - before)
              .count();
      allocations += count.allocations();
      ++ticks;
      not_solved += command.status == TickStatus::kTruncated ||
                    command.status == TickStatus::kFailSafe;
      if (round >= kTimed) continue;
      fastest[k] = std::min(fastest[k], us);
      raw.push_back(us);
    }
  }
  EXPECT_GE(ticks, 1000000);
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(not_solved, 0);
  std::printf("%ld ticks, %ld allocations\n", ticks, allocations);
  Print("fastest of 5", fastest);
  Print("raw", raw);
}

}  // namespace
}  // namespace poise
