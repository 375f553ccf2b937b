// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/unmodelled_acceleration.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/tests/util/count_malloc.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;

class UnmodelledAccelerationTest : public testing::Test {
 protected:
  // Simulates ticks in which v̇ exceeds its prediction by `unmodelled`.
  void Run(int ticks, const Eigen::Vector2d& unmodelled) {
    for (int i = 0; i < ticks; ++i) {
      estimate_.Predict(kDt, v_, vdot_);
      v_ += kDt * (vdot_ + unmodelled);
      estimate_.Update(kDt, v_);
    }
  }

  UnmodelledAcceleration estimate_{2};
  Eigen::VectorXd v_ = Eigen::Vector2d(0.3, -0.2);
  const Eigen::VectorXd vdot_ = Eigen::Vector2d(5, -7);
};

TEST_F(UnmodelledAccelerationTest, IsZeroWhilePredictionIsRight) {
  Run(50, {0, 0});
  EXPECT_LT(estimate_.vdot().norm(), 1e-9);
}

TEST_F(UnmodelledAccelerationTest, FollowsAStepWithTheTimeConstant) {
  Run(20, {10, -20});  // 20 ms: one time constant.
  const Eigen::Vector2d wanted = (1 - std::exp(-1)) * Eigen::Vector2d(10, -20);
  EXPECT_LT((estimate_.vdot() - wanted).norm(), 1e-9);
}

TEST_F(UnmodelledAccelerationTest, IsClampedAtOneHundred) {
  Run(200, {1000, -1000});
  EXPECT_EQ(estimate_.vdot()[0], 100);
  EXPECT_EQ(estimate_.vdot()[1], -100);
}

// By Froude's rule, a robot four times as large moves half as fast in rad/s,
// and its angular accelerations are a quarter. Its estimate is then a quarter,
// also at the clamp.
TEST_F(UnmodelledAccelerationTest, ScalesWithTheRobot) {
  UnmodelledAcceleration large(2, {4, 64});
  for (const double size : {10.0, 1000.0}) {
    const Eigen::Vector2d unmodelled(size, -2 * size);
    Eigen::VectorXd v = v_ / 2;
    for (int i = 0; i < 20; ++i) {
      large.Predict(2 * kDt, v, vdot_ / 4);
      v += 2 * kDt * (vdot_ + unmodelled) / 4;
      large.Update(2 * kDt, v);
    }
    Run(20, unmodelled);
    // Differences of velocities of 1 rad/s over 1 ms lose three digits.
    EXPECT_LT((large.vdot() - estimate_.vdot() / 4).norm(), 1e-9) << size;
  }
  EXPECT_EQ(large.vdot()[1], -25);
}

TEST_F(UnmodelledAccelerationTest, KeepsItsValueWithoutAPrediction) {
  Run(10, {10, 0});
  const Eigen::VectorXd before = estimate_.vdot();
  estimate_.ForgetPrediction();
  estimate_.Update(kDt, v_ + Eigen::Vector2d(1, 1));
  EXPECT_EQ(estimate_.vdot(), before);
  estimate_.Reset();
  EXPECT_EQ(estimate_.vdot(), Eigen::VectorXd(Eigen::Vector2d(0, 0)));
}

TEST_F(UnmodelledAccelerationTest, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  const Eigen::VectorXd later = v_ + kDt * vdot_;
  CountMalloc count;
  estimate_.Predict(kDt, v_, vdot_);
  estimate_.Update(kDt, later);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
