// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/push_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;

class PushEstimateTest : public testing::Test {
 protected:
  PushEstimateTest()
      : robot_(LoadHumanoid()),
        tick_(robot_.model.tree, {}),
        nothing_(Eigen::VectorXd::Zero(robot_.model.tree.nv())),
        estimate_(robot_.model.tree.total_mass(), {}) {
    ComputeTick(robot_.model.tree, robot_.q_nominal, nothing_, &tick_);
  }

  // The change of v̇ that a force at the origin of the base makes, with all
  // torques and contact forces unchanged: M v̇ = J' f.
  Eigen::VectorXd Effect(const Eigen::Vector3d& force_W) const {
    Eigen::VectorXd generalized = nothing_;
    generalized.segment<3>(3) = force_W;
    return tick_.M.ldlt().solve(generalized);
  }

  void Run(const Eigen::VectorXd& effect, double time) {
    for (int i = 0; i < std::lround(time / kDt); ++i) {
      estimate_.Update(kDt, tick_, effect);
    }
  }

  Robot robot_;
  Tick tick_;
  Eigen::VectorXd nothing_;
  PushEstimate estimate_;
};

// Second derivation: by Newton's second law the acceleration is f / m, although
// the force turns the robot and bends its joints.
TEST_F(PushEstimateTest, IsForceOverMass) {
  const Eigen::Vector3d force(120, -80, 0);
  Run(Effect(force), kDt);
  const Eigen::Vector2d expected =
      force.head<2>() / robot_.model.tree.total_mass();
  // The condition of M: from the base's mass to that of a finger.
  EXPECT_LT((estimate_.a_WG() - expected).norm(),
            Rounding(expected.norm(), robot_.model.tree.nv(), 1e6));
  EXPECT_TRUE(estimate_.acts());
}

TEST_F(PushEstimateTest, ExpectsAPushToLastForTheExpectedTime) {
  const Eigen::VectorXd effect = Effect({300, 0, 0});
  EXPECT_EQ(estimate_.remaining(), 0);
  Run(effect, 0.04);
  EXPECT_NEAR(estimate_.remaining(), 0.06, 1e-9);
  Run(effect, 0.1);
  EXPECT_TRUE(estimate_.acts());
  EXPECT_EQ(estimate_.remaining(), 0);  // Longer than expected.
  Run(nothing_, kDt);
  EXPECT_FALSE(estimate_.acts());
  // A short pause does not start a new push; a long one does.
  Run(effect, kDt);
  EXPECT_EQ(estimate_.remaining(), 0);
  Run(nothing_, 0.06);
  Run(effect, kDt);
  EXPECT_NEAR(estimate_.remaining(), 0.099, 1e-9);
}

TEST_F(PushEstimateTest, IgnoresAWeakForce) {
  Run(Effect({20, 0, 0}), 0.05);
  EXPECT_FALSE(estimate_.acts());
}

TEST_F(PushEstimateTest, ResetForgets) {
  Run(Effect({300, 0, 0}), 0.05);
  estimate_.Reset();
  EXPECT_FALSE(estimate_.acts());
  EXPECT_TRUE(estimate_.a_WG().isZero());
  Run(Effect({300, 0, 0}), kDt);
  EXPECT_NEAR(estimate_.remaining(), 0.099, 1e-9);
}

}  // namespace
}  // namespace poise
