// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/judge.h"
#include "poise/sim/observation.h"
#include "poise/sim/start_state.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr double kMinutes = 10;
constexpr double kBetweenPushes = 3;  // s.

// Returns the number of resident memory pages of this process.
long ResidentPages() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident;
}

// Returns random pushes, one every three seconds, each with at most a third of
// the pendulum's impulse.
std::vector<Push> MakePushes() {
  std::vector<Push> pushes;
  RandomStream random(1);
  for (double at = 1; at < 60 * kMinutes - kBetweenPushes;
       at += kBetweenPushes) {
    const double angle = 2 * M_PI * random.Uniform();
    const double force = 50 * random.Uniform();
    Push push;
    push.start = at;
    push.duration = 0.05 + 0.1 * random.Uniform();
    push.force = {force * std::cos(angle), force * std::sin(angle), 0};
    push.profile =
        random.Uniform() < 0.5 ? PushProfile::kBox : PushProfile::kHalfSine;
    pushes.push_back(push);
  }
  return pushes;
}

TEST(Soak, RobotRecoversFromTenMinutesOfRandomPushes) {
  const Robot robot = LoadHumanoid();
  Scenario scenario = LoadScenario("sim/scenarios/stand.yaml");
  scenario.duration = 60 * kMinutes;
  scenario.pushes = MakePushes();
  ClosedLoop loop(robot, scenario);
  Judge judge(StandingHeight(robot));
  // A second controller receives the true state in one of ten ticks. The test
  // counts its allocations.
  Controller beside(robot);
  beside.Start(MakeStartState(robot, {}, {}, scenario.seed));
  Command command;
  command.tau.setZero(robot.model.tree.num_joints());
  long pages = 0, ticks = 0;
  int allocations = 0;
  std::vector<double> not_solved;
  while (loop.time() < scenario.duration && !judge.is_down()) {
    loop.Tick();
    const TickRecord record = loop.record();
    judge.Look(record.observation);
    if (record.report.status == TickStatus::kTruncated ||
        record.report.status == TickStatus::kFailSafe) {
      not_solved.push_back(record.observation.time);
    }
    if (++ticks % 10 == 0) {
      const State state{record.start.time, record.start.q, record.start.v};
      const CountMalloc count;
      beside.Update(state, &command);
      allocations += count.allocations();
    }
    // After one minute all buffers have their final size.
    if (pages == 0 && loop.time() > 60) pages = ResidentPages();
  }
  const Verdict verdict = judge.Conclude();
  EXPECT_TRUE(verdict.recovered)
      << "fell at, s: " << verdict.fell_at.value_or(-1);
  EXPECT_LT(verdict.com_error_final.norm(), 1e-3);
  EXPECT_EQ(allocations, 0);
  EXPECT_TRUE(not_solved.empty())
      << not_solved.size() << " ticks were not solved, the first at "
      << not_solved[0] << " s";
  EXPECT_LT(ResidentPages() - pages, 256);  // 1 MiB.
  EXPECT_LT((loop.plant().Sense().q - robot.q_nominal)
                .tail(robot.model.tree.num_joints())
                .cwiseAbs()
                .maxCoeff(),
            0.05);
  RecordProperty("foot_slide_mm",
                 std::to_string(1e3 * verdict.foot_slide_peak));
  RecordProperty("com_error_peak_mm",
                 std::to_string(1e3 * verdict.com_error_peak.norm()));
}

// Returns shoves of a minute, up to half of what the robot recovers from in its
// weakest direction, 37.5 N s. A shove may come 0.3 s after the one before,
// while the robot still steps.
std::vector<Push> MakeShoves(unsigned seed) {
  std::vector<Push> shoves;
  RandomStream random(seed);
  for (double at = 1; at < 55; at += 0.3 + 2.7 * random.Uniform()) {
    const double angle = 2 * M_PI * random.Uniform();
    Push push;
    push.start = at;
    push.duration = 0.1;
    push.force = 187.5 * random.Uniform() *
                 Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    shoves.push_back(push);
  }
  return shoves;
}

// Ten minutes, each with a robot that stands up anew. The aim is no fall. Two
// shoves within 0.3 s add up to more than the robot recovers from, so that a
// fall is possible; 1 % of the shoves is far below what one defect would cause.
TEST(Soak, RobotThatStepsRecoversFromTenMinutesOfRandomShoves) {
  const Robot robot = LoadHumanoid();
  std::size_t shoves = 0, steps = 0, falls = 0;
  for (unsigned minute = 1; minute <= 10; ++minute) {
    Scenario scenario = LoadScenario("sim/scenarios/stand.yaml");
    scenario.steps = true;
    scenario.duration = 60;
    scenario.pushes = MakeShoves(minute);
    ClosedLoop loop(robot, scenario);
    Judge judge(StandingHeight(robot), true);
    bool was_swinging = false;
    while (loop.time() < scenario.duration && !judge.is_down()) {
      loop.Tick();
      judge.Look(loop.observation());
      const bool swings = loop.gait()->phase() == GaitPhase::kSwing;
      if (swings && !was_swinging) ++steps;
      was_swinging = swings;
    }
    shoves += scenario.pushes.size();
    if (judge.is_down()) ++falls;
  }
  std::printf("%zu shoves, %zu steps, %zu falls\n", shoves, steps, falls);
  EXPECT_GT(steps, 0u);
  EXPECT_LT(falls, 0.01 * static_cast<double>(shoves));
}

}  // namespace
}  // namespace poise
