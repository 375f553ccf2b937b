// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/com_glide.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "poise/tests/util/arbitrary.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;

Reference At(const Eigen::Vector3d& p_WG, double ground_z) {
  Reference reference;
  reference.p_WG = p_WG;
  reference.ground_z = ground_z;
  return reference;
}

// Without a change of the goal, the reference comes to rest there.
RC_GTEST_PROP(ComGlide, EndsAtRestAtTheGoal, ()) {
  const double ground_z = *Numbers(1);
  Reference reference = At((*VectorsXd(3, 1)).head<3>(), ground_z);
  const Eigen::Vector2d goal = (*VectorsXd(2, 1)).head<2>();
  const double height = 0.7;
  ComGlide com;
  com.StartAt(reference);
  for (double t = 0; t < 0.7; t += kDt) {
    com.MoveTo(kDt, goal, height, 0.5 - t, &reference);
  }
  // The last 20 ms brake: the rest of the way is (0.02 / 0.5)³ times 10 of the
  // whole, at most 3 m.
  RC_ASSERT((reference.p_WG.head<2>() - goal).norm() < 2e-3);
  RC_ASSERT(std::abs(reference.p_WG.z() - ground_z - height) < 2e-3);
  RC_ASSERT(reference.v_WG.norm() < 1e-6);
}

// Velocities are the derivatives of positions while the goal moves.
RC_GTEST_PROP(ComGlide, IsConsistentWhenTheGoalMoves, ()) {
  Reference reference = At((*VectorsXd(3, 1)).head<3>(), 0);
  ComGlide com;
  com.StartAt(reference);
  Eigen::Vector2d goal = (*VectorsXd(2, 1)).head<2>();
  for (double t = 0; t < 0.6; t += kDt) {
    const Reference before = reference;
    goal += 0.01 * (*VectorsXd(2, 1)).head<2>();
    com.MoveTo(kDt, goal, 0.7, 0.5 - t, &reference);
    const Eigen::Vector3d mean = (before.v_WG + reference.v_WG) / 2;
    // The trapezoidal rule is wrong by dt³ / 12 times the third derivative,
    // at most 60 m / (0.02 s)³, and by the change to braking, dt² / 2 times
    // the change of the acceleration.
    RC_ASSERT((reference.p_WG - before.p_WG - kDt * mean).norm() < 2e-3);
  }
}

TEST(ComGlide, MovesTheHeightAlone) {
  Reference reference = At({0.1, 0.2, 0.8}, 0);
  ComGlide com;
  com.StartAt(reference);
  com.MoveHeightTo(kDt, 0.7, 0.1, &reference);
  EXPECT_EQ(reference.p_WG.head<2>(), Eigen::Vector2d(0.1, 0.2));
  EXPECT_EQ(reference.v_WG.head<2>(), Eigen::Vector2d::Zero());
  EXPECT_LT(reference.p_WG.z(), 0.8);
  EXPECT_LT(reference.v_WG.z(), 0);
}

// The plane restarts at the measured motion; the height does not jump.
TEST(ComGlide, RestartsThePlaneWithAVelocity) {
  Reference reference = At({0, 0, 0.8}, 0);
  ComGlide com;
  com.StartAt(reference);
  for (int i = 0; i < 50; ++i) {
    com.MoveHeightTo(kDt, 0.7, 0.1 - i * kDt, &reference);
  }
  const Reference before = reference;
  com.RestartPlane({0.3, -0.1}, {0.5, 0.2});
  com.MoveTo(kDt, {0, 0}, 0.7, 0.05, &reference);
  // One tick at 0.5 m/s, with an acceleration of up to 10 times 0.3 m over
  // (0.05 s)².
  EXPECT_NEAR(reference.p_WG.x(), 0.3 + 0.5 * kDt, 1e-3);
  EXPECT_NEAR(reference.p_WG.y(), -0.1 + 0.2 * kDt, 1e-3);
  const double mean = (before.v_WG.z() + reference.v_WG.z()) / 2;
  EXPECT_NEAR(reference.p_WG.z(), before.p_WG.z() + kDt * mean, 1e-5);
}

}  // namespace
}  // namespace poise
