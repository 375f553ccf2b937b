// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests the physics of the paper's scenarios and of a standing robot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/sim/story_fixture.h"

namespace poise {
namespace {

// Checks every tick of a scenario of the paper in which the robot does not
// fall: the CoP is 5 mm inside each sole, friction is within 0.8 of the ground
// and 0.5 of the controller, the feet do not move, and no limit is violated.
void ExpectStaysOnItsFeet(const Story& story) {
  EXPECT_TRUE(story.verdict.recovered);
  EXPECT_EQ(story.failures, 0);
  EXPECT_LT(story.asked_beyond, -0.005 + 1e-6);
  EXPECT_LT(story.given_beyond,
            1e-4);  // Soles have spheres of 5 mm, which roll.
  EXPECT_LT(story.asked_friction, 0.5 + 1e-6);
  EXPECT_LT(story.given_friction, 0.81);  // 50 sweeps: 1 % over 0.8.
  EXPECT_LT(story.verdict.foot_tilt_peak, 0.02);
  EXPECT_LT(story.verdict.foot_slide_peak, 2e-3);
  EXPECT_LE(story.torque_violation, 1e-6);
  EXPECT_LE(story.joint_violation, 1e-6);
}

TEST(Paper, StandsWhenStartedOffEquilibrium) {
  const Story story = Tell(Ours("stand", 3));
  ExpectStaysOnItsFeet(story);
  const Verdict& verdict = story.verdict;
  EXPECT_LT(verdict.com_error_final.norm(), 1e-4);  // A tenth of a millimeter.
  EXPECT_GT(verdict.com_error_peak.norm(), 1e-3);   // It was off equilibrium.
}

TEST(Paper, RecoversFromTheWeakPush) {
  const Story story = Tell(Ours("weak_push", 4));
  ExpectStaysOnItsFeet(story);
  // 2 mm: a seventh of the peak error.
  EXPECT_LT(story.verdict.com_error_final.norm(), 2e-3);
  // A large error at the push, then a transient that converges to zero.
  EXPECT_GT(story.ErrorIn(1, 1.5), 0.01);
  EXPECT_LT(story.ErrorIn(2, 2.5), 2e-3);
  EXPECT_LT(story.ErrorIn(3, 4), 5e-4);
}

TEST(Paper, FallsFromTheStrongPushWithoutCop) {
  const Story story = Tell(Ours("strong_push_without_zmp", 4));
  EXPECT_FALSE(story.verdict.recovered);
  ASSERT_TRUE(story.verdict.fell_at);
  EXPECT_GT(*story.verdict.fell_at, 1);
  EXPECT_LT(story.com_error.size(), 4000u);  // The run stopped at the fall.
  // The commanded CoP is outside the sole, and the error diverges.
  EXPECT_GT(story.asked_beyond, 0.05);
  EXPECT_GT(story.com_error.back(), 0.1);
}

TEST(Paper, RecoversFromTheStrongPush) {
  const Story story = Tell(Ours("strong_push", 4));
  ExpectStaysOnItsFeet(story);
  // The transient is larger than that of the weak push, but it converges.
  EXPECT_GT(story.ErrorIn(1, 1.5), 0.03);
  EXPECT_LT(story.ErrorIn(2.5, 3), 2e-3);
  EXPECT_LT(story.ErrorIn(3.5, 4), 5e-4);
}

TEST(Paper, CombinedBoxPinsTheCop) {
  Scenario scenario = Ours("strong_push", 3);
  scenario.pushes[0].duration = 0.12;
  scenario.control.with = {"zmp"};
  ClosedLoop loop(Humanoid(), scenario);
  int pinned = 0;
  double highest = 0;
  while (loop.time() < 3) {
    loop.Tick();
    const double y = loop.observation().cop.y();
    if (std::abs(y - 0.1) < 0.5e-3) ++pinned;
    highest = std::max(highest, y);
  }
  // The plant's contacts follow the command to 0.5 mm. The bound of 1 mm
  // detects a collision: an arm that hits the trunk moves the CoP by 9 mm.
  EXPECT_GT(pinned, 150);
  EXPECT_LT(highest, 0.101);
}

TEST(Paper, SinusoidLagsOnlyWithoutFeedforward) {
  Scenario scenario = Ours("com_sinusoid", 4);
  const double w = 2 * M_PI / 10;
  for (const bool feedforward : {false, true}) {
    SCOPED_TRACE(feedforward);
    scenario.control.feedforward = feedforward;
    ClosedLoop loop(Humanoid(), scenario);
    double worst = 0;
    while (loop.time() < 4) {
      loop.Tick();
      const Observation& now = loop.observation();
      if (now.time < 3) continue;
      // The lag is K_d v / K_p with K_d = 10 and K_p = 30. The acceleration
      // adds a tenth of the lag, which the tolerance allows.
      const double lag =
          feedforward ? 0 : -0.08 * w * std::cos(w * now.time) / 3;
      worst = std::max(worst, std::abs(now.com.x() - now.com_ref.x() - lag));
    }
    EXPECT_LT(worst, feedforward ? 1e-4 : 2.5e-3);
  }
}

TEST(Paper, ArmsDriftOnlyWithoutThePostureTask) {
  const auto drift = [](bool posture) {
    Scenario scenario = Ours("posture_off", 4);
    if (posture) scenario.control.without.clear();
    ClosedLoop loop(Humanoid(), scenario);
    while (loop.time() < 4) loop.Tick();
    const int n = Humanoid().model.tree.num_joints();
    return (loop.plant().Sense().q - Humanoid().q_nominal)
        .tail(n)
        .cwiseAbs()
        .maxCoeff();
  };
  EXPECT_LT(drift(true), 0.02);
  EXPECT_GT(drift(false), 0.2);
}

TEST(Standing, MeasuredWrenchIsTheCommandedOne) {
  Scenario scenario = Ours("stand", 2);
  scenario.start = {};
  ClosedLoop loop(Humanoid(), scenario);
  while (loop.time() < 2) loop.Tick();
  const TickRecord record = loop.record();
  const int nv = Humanoid().model.tree.nv();
  double sum = 0;
  for (int i = 0; i < 2; ++i) {
    const auto measured = loop.observation().feet[i].F_Co_C;
    const auto commanded = record.report.foot_wrench(nv, i);
    // 0.05 N, of the load of 190 N per foot.
    EXPECT_LT((measured - commanded).tail<3>().norm(), 0.05);
    EXPECT_NEAR(measured[1] / measured[5], commanded[1] / commanded[5], 1e-3);
    EXPECT_NEAR(measured[0] / measured[5], commanded[0] / commanded[5], 1e-3);
    sum += measured[5];
  }
  EXPECT_NEAR(sum, Humanoid().model.tree.total_mass() * 9.81, 1e-3);
}

// The CoM moves over the left foot until the CoP reaches the edge that the
// controller allows.
TEST(Standing, MeasuredCopIsTheCommandedOneUntilItSaturates) {
  Scenario scenario = Ours("stand", 1.2);
  scenario.start = {};
  scenario.com = {{0, 0.13, 0}, Eigen::Vector3d::Zero(), 4};
  ClosedLoop loop(Humanoid(), scenario);
  const int nv = Humanoid().model.tree.nv();
  double least = 1, most = -1, worst = 0;
  while (loop.time() < 1.2) {
    loop.Tick();
    const TickRecord record = loop.record();
    for (int i = 0; i < 2; ++i) {
      const auto measured = loop.observation().feet[i].F_Co_C;
      const auto commanded = record.report.foot_wrench(nv, i);
      if (commanded[5] < 20)
        continue;  // The CoP of a small load is inaccurate.
      const Eigen::Vector2d cop(-commanded[1] / commanded[5],
                                commanded[0] / commanded[5]);
      worst = std::max({worst, std::abs(-measured[1] / measured[5] - cop.x()),
                        std::abs(measured[0] / measured[5] - cop.y())});
      least = std::min(least, cop.y());
      most = std::max(most, cop.y());
    }
  }
  EXPECT_LT(worst, 1e-3);  // A fifth of the controller's margin to the edge.
  EXPECT_GT(most, 0.059);  // The sole ends at 0.065 m.
  EXPECT_LT(least, 0.01);
}

}  // namespace
}  // namespace poise
