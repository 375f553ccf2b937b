// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/balance_monitor.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/math/so3.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/robot.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr double kHeight = 0.9;      // Center of mass above the soles, m.
constexpr double kHalfStance = 0.1;  // From the middle to each foot, m.

// A robot at rest above two feet on flat ground; each test changes some values.
class BalanceMonitorTest : public testing::Test {
 protected:
  BalanceMonitorTest() {
    tick_.p_WG << 0, 0, kHeight;
    tick_.v_WG.setZero();
    tick_.L_G.setZero();
    tick_.X_WB[0] = Pose();
    contacts_[0].X_WC.p << 0, kHalfStance, 0;
    contacts_[1].X_WC.p << 0, -kHalfStance, 0;
    reference_.p_WG = tick_.p_WG;
    normal_force_.setConstant(2, weight_ / 2);
  }

  const Balance& Update() {
    monitor_.Update(tick_, contacts_, reference_, settings_, normal_force_);
    return monitor_.balance();
  }

  // Sets the speed of the center of mass that puts the capture point at (x, y).
  void PushTo(double x, double y) { tick_.v_WG << x * w_, y * w_, 0; }

  const Robot robot_ = LoadHumanoid();
  const Tree& tree_ = robot_.model.tree;
  const double mass_ = tree_.total_mass();
  const double weight_ = mass_ * 9.81;
  const double w_ = std::sqrt(9.81 / kHeight);
  const double front_ = robot_.feet[0].half_size.x();
  const double edge_ = kHalfStance + robot_.feet[0].half_size.y();
  Tick tick_{tree_, {}};
  std::vector<ContactTick> contacts_{2};
  Reference reference_;
  CaptureSettings settings_;
  Eigen::VectorXd normal_force_;
  BalanceMonitor monitor_{tree_, robot_.feet};
};

TEST_F(BalanceMonitorTest, CapturePointAddsAngularMomentumToVelocity) {
  tick_.p_WG.x() = 0.01;
  tick_.v_WG << 0.2, -0.1, 0.3;
  tick_.L_G << 3, 5, 7, 0, 0, 0;
  // k x z = (k_y, -k_x, 0).
  const Eigen::Vector3d& xi = Update().xi_Mid;
  EXPECT_NEAR(xi.x(), 0.01 + (0.2 + 5 / (mass_ * kHeight)) / w_, 1e-12);
  EXPECT_NEAR(xi.y(), (-0.1 - 3 / (mass_ * kHeight)) / w_, 1e-12);
}

TEST_F(BalanceMonitorTest, ShareGrowsFromBeginningOfBlendToEdge) {
  for (const double side : {1.0, -1.0}) {
    PushTo(0.64 * side * front_, 0);
    EXPECT_EQ(Update().capture, 0);
    PushTo(0.825 * side * front_, 0);
    EXPECT_NEAR(Update().capture, 0.5, 1e-9);
    PushTo(1.1 * side * front_, 0);
    EXPECT_EQ(Update().capture, 1);
    EXPECT_EQ(Update().left + Update().right, 0);
  }
}

TEST_F(BalanceMonitorTest, SidewaysShareBelongsToSideOfFall) {
  PushTo(0, 0.825 * 1.25 * edge_);
  EXPECT_NEAR(Update().left, 0.5, 1e-9);
  EXPECT_EQ(Update().right, 0);
  PushTo(0, -0.825 * 1.25 * edge_);
  EXPECT_NEAR(Update().right, 0.5, 1e-9);
  EXPECT_EQ(Update().left, 0);
  EXPECT_EQ(Update().capture, Update().right);
}

TEST_F(BalanceMonitorTest, SettingsShiftAndScaleTheBlend) {
  settings_ = {0.8, 0.5, 1.5, 2};
  PushTo(front_, 0);
  EXPECT_NEAR(Update().capture, 0.8 * 0.5, 1e-9);
  PushTo(0, 2 * edge_);
  EXPECT_NEAR(Update().left, 0.8 * 0.5, 1e-9);
  settings_.capture = 0;
  EXPECT_EQ(Update().capture, 0);
}

TEST_F(BalanceMonitorTest, ReleasesUnloadedFootAwayFromFall) {
  PushTo(0, -1.25 * edge_);
  normal_force_ << 0.02 * weight_, 0.9 * weight_;
  const std::vector<Balance::FootVerdict>& feet = Update().feet;
  EXPECT_TRUE(feet[0].is_released);
  EXPECT_FALSE(feet[0].comes_back);
  EXPECT_FALSE(feet[1].is_released);

  normal_force_[0] = 0.04 * weight_;  // The foot still carries load.
  EXPECT_FALSE(Update().feet[0].is_released);
  // No other foot carries the robot.
  normal_force_ << 0.02 * weight_, 0.4 * weight_;
  EXPECT_FALSE(Update().feet[0].is_released);
  normal_force_ << 0.02 * weight_, 0.9 * weight_;
  PushTo(0, -0.8 * 1.25 * edge_);  // The share is below one half.
  EXPECT_GT(Update().right, 0.4);
  EXPECT_FALSE(Update().feet[0].is_released);
  PushTo(0, 1.25 * edge_);  // The robot falls to the side of the foot.
  EXPECT_FALSE(Update().feet[0].is_released);
}

TEST_F(BalanceMonitorTest, FootComesBackWhenFallTurnsToItsSide) {
  PushTo(0, 0.9 * 1.25 * edge_);
  EXPECT_TRUE(Update().feet[0].comes_back);
  EXPECT_FALSE(Update().feet[1].comes_back);
}

TEST_F(BalanceMonitorTest, FootComesBackWhenRobotIsSlowAndUpright) {
  const auto comes_back = [&] { return Update().feet[0].comes_back; };
  EXPECT_TRUE(comes_back());
  tick_.X_WB[0].R = ExpSo3({0.39, 0, 0});
  EXPECT_TRUE(comes_back());
  tick_.X_WB[0].R = ExpSo3({0.41, 0, 0});
  EXPECT_FALSE(comes_back());
  reference_.R_WB = tick_.X_WB[0].R;
  EXPECT_TRUE(comes_back());
  tick_.v_WG << 0, 0, 0.31;  // Upward, so that no share grows.
  EXPECT_FALSE(comes_back());
}

TEST_F(BalanceMonitorTest, TargetOfCenterOfMassIsOverStandingFoot) {
  const auto target = [&] {
    return FindComTarget(robot_.feet, contacts_, reference_);
  };
  reference_.p_WG << 0.5, -0.3, kHeight;
  EXPECT_EQ(target(), reference_.p_WG);
  contacts_[1].in_contact = false;
  const Eigen::Vector2d half = robot_.feet[0].half_size;
  const Eigen::Vector3d corner(0.5 * half.x(), kHalfStance - 0.5 * half.y(),
                               kHeight);
  EXPECT_LT((target() - corner).norm(), 1e-12);
  contacts_[0].in_contact = false;
  EXPECT_EQ(target(), reference_.p_WG);
}

TEST_F(BalanceMonitorTest, PendulumFrequencyIsBoundedForFallenRobot) {
  EXPECT_EQ(PendulumFrequency(9.81, 0.9), std::sqrt(9.81 / 0.9));
  EXPECT_EQ(PendulumFrequency(9.81, -1), std::sqrt(9.81 / 0.05));
}

TEST_F(BalanceMonitorTest, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  Update();
  CountMalloc count;
  Update();
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
