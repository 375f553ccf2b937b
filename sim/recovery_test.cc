// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests beyond the paper: a wrong model, standing on one leg, the largest
// pushes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/sim/run.h"
#include "poise/sim/story_fixture.h"

namespace poise {
namespace {

// The bound for each axis is half of the 3 mm that //tools:robustness allows.
// Without the integral correction, a model whose masses are too small leaves an
// error of 4 mm in x and 17 mm in z.
TEST(WrongModel, HasNoFinalError) {
  Scenario scenario = Ours("stand", 4);
  scenario.control.mass_error = -0.1;
  const Verdict verdict = poise::Run(Humanoid(), scenario).verdict;
  EXPECT_TRUE(verdict.recovered);
  EXPECT_LT(verdict.com_error_final.cwiseAbs().maxCoeff(), 1.5e-3);
}

// Without the integral correction the error is 17.8 mm.
TEST(WrongModel, HasNoFinalErrorWithTheComTask) {
  Scenario scenario = Ours("stand", 4);
  scenario.control.mass_error = 0.1;
  scenario.control.without = {"momentum"};
  scenario.control.with = {"com", "angular_momentum"};
  const Verdict verdict = poise::Run(Humanoid(), scenario).verdict;
  EXPECT_TRUE(verdict.recovered);
  EXPECT_LT(verdict.com_error_final.cwiseAbs().maxCoeff(), 1.5e-3);
}

RunResult RunOurs(const std::string& name, double duration) {
  return poise::Run(Humanoid(), Ours(name, duration));
}

TEST(OneLeg, RecoversFromAPushAndPutsTheOtherFootDown) {
  double in_the_air = 0, pushed_there = 0;  // s, N s.
  FootObservation right;
  const Story story = Tell(Ours("one_leg", 14), [&](const ClosedLoop& loop) {
    right = loop.observation().feet[1];
    if (right.down || right.F_Co_C[5] != 0) return;
    in_the_air += 1e-3;
    pushed_there += 1e-3 * loop.record().push_force_W.norm();
  });
  EXPECT_TRUE(story.verdict.recovered);
  EXPECT_EQ(story.failures, 0);
  EXPECT_LE(story.torque_violation, 1e-6);
  EXPECT_LE(story.joint_violation, 1e-6);
  EXPECT_GT(in_the_air, 5);
  EXPECT_NEAR(pushed_there, 15 * 0.15, 1e-9);  // The whole push.
  EXPECT_TRUE(right.down);
  EXPECT_GT(right.F_Co_C[5], 150);  // 379 N on two feet.
}

// The yardstick uses the one foot on the ground when the push begins.
TEST(OneLeg, UsesThePendulumBoundOfOneFoot) {
  const RunResult result = RunOurs("one_leg", 6.2);
  ASSERT_TRUE(result.yardstick.has_value());
  const double omega = std::sqrt(9.81 / 0.79);  // CoM height within 2 cm.
  const double stretch = omega * 0.15 / -std::expm1(-omega * 0.15);
  const double reach = result.yardstick->lipm_Ns /
                       (Humanoid().model.tree.total_mass() * omega * stretch);
  // Half the width of a sole, plus a quarter of it: the CoM is that far inside.
  EXPECT_NEAR(reach, 1.25 * 0.065, 0.005);
  // A push that never begins has no yardstick.
  EXPECT_FALSE(RunOurs("one_leg", 0.1).yardstick.has_value());
}

// Pushes by nine tenths of the impulse of a pendulum on the feet. The unloaded
// foot is released and returns to its place, and the robot stands as before.
void ExpectAFootLeavesAndComesBack(const Eigen::Vector3d& force) {
  Scenario scenario = Ours("strong_push", 2.6);
  scenario.pushes[0].start = 0.1;
  scenario.pushes[0].duration = 0.1;
  scenario.pushes[0].force = force;
  ClosedLoop loop(Humanoid(), scenario);
  Judge judge(StandingHeight(Humanoid()));
  loop.Tick();
  const Eigen::Vector3d place = loop.observation().feet[1].X_WC.p;
  double away = 0;
  while (loop.time() < 2.5995) {
    loop.Tick();
    const FootObservation& foot = loop.observation().feet[1];
    judge.Look(loop.observation());
    if (!foot.down) away = std::max(away, (foot.X_WC.p - place).norm());
  }
  EXPECT_TRUE(judge.Conclude().recovered);
  EXPECT_GT(away, 0.1);
  EXPECT_TRUE(loop.observation().feet[1].down);
  EXPECT_LT((loop.observation().feet[1].X_WC.p - place).norm(), 0.01);
  EXPECT_LT(loop.observation().base_tilt, 0.05);
}

TEST(LargestPush, ReleasesAFootSidewaysAndBringsItBack) {
  ExpectAFootLeavesAndComesBack({0, 209, 0});
}

// After this push, to the left and backward, the robot is still falling when
// the foot begins its return, from far in front of its place.
TEST(LargestPush, ReleasesAFootDiagonallyAndBringsItBack) {
  ExpectAFootLeavesAndComesBack({-177, 177, 0});
}

}  // namespace
}  // namespace poise
