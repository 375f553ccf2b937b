// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that a robot that is dropped lands on its feet.
#include <gtest/gtest.h>

#include <algorithm>

#include "poise/robot/control/stand.h"
#include "poise/robot/limits.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/judge.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

struct Landing {
  Verdict verdict;
  int flying = 0;    // Ticks without a foot in contact.
  double bent = 0;   // In flight: largest joint error from the posture, rad.
  double force = 0;  // In flight: largest norm of a commanded foot wrench.
  double certificate = 0;  // Worst of all ticks.
  int unsolved = 0;        // Ticks that were not solved to the last level.
  double sunk = 0;         // Largest height of com_ref above the CoM, m.
  double beyond = 0;       // Largest violation of a joint limit, rad.
};

Landing Land(const Scenario& scenario) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  ClosedLoop loop(robot, scenario);
  Judge judge(StandingHeight(robot));
  Landing landing;
  while (loop.time() < scenario.duration - 1e-6 && !judge.is_down()) {
    loop.Tick();
    const Observation& now = loop.observation();
    judge.Look(now);
    const TickRecord record = loop.record();
    landing.certificate =
        std::max(landing.certificate, record.report.certificate.worst());
    landing.unsolved += record.report.failed_level != 0;
    landing.sunk = std::max(landing.sunk, (now.com_ref - now.com).z());
    landing.beyond =
        std::max(landing.beyond, JointViolation(robot.model, record.end.q));
    const auto& contacts = loop.controller().contacts();
    if (contacts[0].in_contact || contacts[1].in_contact) continue;
    ++landing.flying;
    landing.bent = std::max(landing.bent, (record.end.q - robot.q_nominal)
                                              .tail(tree.num_joints())
                                              .lpNorm<Eigen::Infinity>());
    for (int i = 0; i < 2; ++i) {
      landing.force = std::max(landing.force,
                               record.report.foot_wrench(tree.nv(), i).norm());
    }
  }
  landing.verdict = judge.Conclude();
  return landing;
}

// A fall of 10 cm takes 143 ms. The soles detect the ground in the last 4 mm.
// In flight the legs must keep their posture, so that they are not bent at
// landing.
TEST(Landing, KeepsThePostureInFlightAndStands) {
  Scenario scenario;
  scenario.duration = 4;
  scenario.start.drop = 0.1;
  const Landing landing = Land(scenario);
  EXPECT_TRUE(landing.verdict.recovered);
  EXPECT_NEAR(landing.flying, 140, 3);
  // Dry friction and damping of the joints are not in the controller's model.
  // In free fall from rest, nothing but them could move the joints.
  EXPECT_LT(landing.bent, 1e-3);
  EXPECT_LT(landing.force, 1e-9);
  EXPECT_LT(landing.certificate, 1e-9);
  EXPECT_EQ(landing.unsolved, 0);
  EXPECT_LT(landing.sunk,
            0.08);  // It lands at 1.4 m/s; kd / m = 10 / s stops it.
  EXPECT_LE(landing.beyond, 1e-6);
  EXPECT_LT(landing.verdict.foot_tilt_peak, 0.02);
  EXPECT_LT(landing.verdict.foot_slide_peak, 2e-3);
}

// On a slope the edges of the soles touch first, one after the other.
TEST(Landing, StandsOnASlope) {
  Scenario scenario;
  scenario.duration = 4;
  scenario.start.drop = 0.05;
  scenario.start.joints = 0.1;
  scenario.plant.ground.roll = 0.05;
  scenario.plant.ground.pitch = 0.05;
  const Landing landing = Land(scenario);
  EXPECT_TRUE(landing.verdict.recovered);
  EXPECT_GT(landing.flying, 80);
  EXPECT_LE(landing.beyond, 1e-6);
}

}  // namespace
}  // namespace poise
