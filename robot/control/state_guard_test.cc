// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/state_guard.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>

#include "poise/robot/robot.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class StateGuardTest : public testing::Test {
 protected:
  FailSafeReason CheckAt(double time) {
    state_.time = time;
    return guard_.Check(kDt, state_);
  }

  const Robot robot_ = LoadHumanoid();
  const Tree& tree_ = robot_.model.tree;
  StateGuard guard_{tree_};
  State state_{0, robot_.q_nominal, Eigen::VectorXd::Zero(tree_.nv())};
};

TEST_F(StateGuardTest, AcceptsStateWithRunningClock) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(CheckAt(i * kDt), FailSafeReason::kNone);
    EXPECT_TRUE(guard_.clock_moves());
  }
}

TEST_F(StateGuardTest, AcceptsFrozenClockForTenMilliseconds) {
  (void)CheckAt(0);
  for (int i = 1; i <= 10; ++i) {
    EXPECT_EQ(CheckAt(0), FailSafeReason::kNone);
    EXPECT_FALSE(guard_.clock_moves());
  }
  EXPECT_EQ(CheckAt(0), FailSafeReason::kClock);
  EXPECT_EQ(CheckAt(kDt), FailSafeReason::kNone);
}

TEST_F(StateGuardTest, AcceptsClockReset) {
  (void)CheckAt(5);
  EXPECT_EQ(CheckAt(-1), FailSafeReason::kNone);
  EXPECT_EQ(CheckAt(1e3), FailSafeReason::kNone);
}

TEST_F(StateGuardTest, RejectsNaNTime) {
  (void)CheckAt(0);
  for (int i = 1; i <= 10; ++i) {
    EXPECT_EQ(CheckAt(kNaN), FailSafeReason::kState);
  }
  EXPECT_EQ(CheckAt(kNaN), FailSafeReason::kClock);
}

TEST_F(StateGuardTest, RejectsInvalidNumbers) {
  for (const double bad : {kNaN, -1e6, 2e6}) {
    State state = state_;
    state.v[3] = bad;
    EXPECT_FALSE(guard_.IsValid(state));
    state = state_;
    state.q[9] = bad;
    EXPECT_FALSE(guard_.IsValid(state));
    EXPECT_EQ(guard_.Check(kDt, state), FailSafeReason::kState);
  }
}

TEST_F(StateGuardTest, RejectsQuaternionThatIsNotNormalised) {
  for (const double factor : {0.9995, 1.0005}) {
    State state = state_;
    state.q.segment<4>(3) *= factor;
    EXPECT_TRUE(guard_.IsValid(state));
  }
  for (const double factor : {0.0, 0.998, 1.002}) {
    State state = state_;
    state.q.segment<4>(3) *= factor;
    EXPECT_FALSE(guard_.IsValid(state));
  }
}

TEST_F(StateGuardTest, ResetForgetsTheClock) {
  for (int i = 0; i <= 11; ++i) (void)CheckAt(0);
  guard_.Reset();
  EXPECT_EQ(CheckAt(0), FailSafeReason::kNone);
  EXPECT_TRUE(guard_.clock_moves());
}

}  // namespace
}  // namespace poise
