// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests how the controller compensates effects that its model does not contain:
// a push on a joint near its stop, and a disturbance of the center of mass.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "poise/dynamics/integrate.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/controller_fixture.h"

namespace poise {
namespace {

// Simulates a push on an elbow near its stop. All other joints follow the
// solution.
class PushedElbow : public ControllerTest {
 protected:
  PushedElbow() {
    state_.q[7 + elbow_] = stop_ - 0.02;
    controller_.reference().posture[elbow_] = stop_ + 0.1;
  }

  // Applies the push, rad/s2. Returns the largest position beyond the stop,
  // rad.
  double Run(double push, double seconds) {
    double farthest = -1;
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) {
      Update();
      EXPECT_NE(command_.status, TickStatus::kFailSafe);
      state_.v += 1e-3 * controller_.report().y.head(tree().nv());
      state_.v[6 + elbow_] += 1e-3 * push;
      Integrate(tree(), state_.q, state_.v, 1e-3, state_.q);
      farthest = std::max(farthest, state_.q[7 + elbow_] - stop_);
    }
    return farthest;
  }

  const int elbow_ = *tree().FindJoint("l_elbow");
  const double stop_ = robot_.model.limits[elbow_].upper;
};

TEST_F(PushedElbow, StaysInsideLimitUnderPush) {
  EXPECT_LT(Run(30, 1), -1e-3);
  // As without a push, the joint keeps the margin from its stop.
  EXPECT_NEAR(state_.q[7 + elbow_], stop_ - 0.008, 1e-4);
}

TEST_F(PushedElbow, ReturnsToMarginAfterPushEnds) {
  (void)Run(-30, 0.3);
  (void)Run(0, 1);
  EXPECT_NEAR(state_.q[7 + elbow_], stop_ - 0.008, 1e-4);
}

TEST_F(PushedElbow, StartResetsTheEstimate) {
  (void)Run(30, 0.3);
  const State pushed = state_;
  controller_.Start(pushed);
  controller_.reference().posture[elbow_] = stop_ + 0.1;
  Update();
  const Eigen::VectorXd y = controller_.report().y;
  Controller other(robot_);
  other.Start(pushed);
  other.reference().posture[elbow_] = stop_ + 0.1;
  other.Update(state_, &command_);
  EXPECT_LT((other.report().y - y).norm(), 1e-9 * y.norm());
}

TEST_F(PushedElbow, KeepsEstimateWhileClockIsFrozen) {
  (void)Run(30, 0.3);
  const auto bound = [this] {
    return controller_.report().y[6 + elbow_] +
           40 * 40 * (state_.q[7 + elbow_] - stop_ + 0.008) +
           80 * state_.v[6 + elbow_];
  };
  const double before = bound();
  EXPECT_NEAR(before, -30, 0.1);
  for (int i = 0; i < 5; ++i) controller_.Update(state_, &command_);
  EXPECT_NEAR(bound(), before, 0.1);
  state_.v[6 + elbow_] -= 0.01;  // Changed while the clock stood still.
  Update();
  EXPECT_NEAR(bound(), before, 0.1);
}

// Measures the correction of Disturbance: the acceleration of the center of
// mass in the solution, minus the PD part.
class CorrectionTest : public ControllerTest {
 protected:
  Eigen::Vector3d Correction() {
    const Tick& tick = controller_.tick();
    const Eigen::Vector3d a_W =
        (tick.H_G.bottomRows<3>() * controller_.report().y.head(tree().nv()) +
         tick.H_G_bias.tail<3>()) /
        tree().total_mass();
    return a_W - 30 * (controller_.reference().p_WG - tick.p_WG) +
           10 * tick.v_WG;
  }

  // Returns the change of the correction in a number of ticks.
  Eigen::Vector3d Gained(int ticks) {
    Update();
    const Eigen::Vector3d before = Correction();
    for (int i = 0; i < ticks; ++i) Update();
    return Correction() - before;
  }

  void ExpectGains(const Eigen::Vector3d& a_second) {
    EXPECT_LT((Gained(20) - 0.02 * a_second).norm(), 1e-7);
  }
};

TEST_F(CorrectionTest, IntegratesErrorBeyondPdGains) {
  controller_.reference().p_WG += Eigen::Vector3d(0.004, -0.003, 0.005);
  const double kx = 15 * 0.004, ky = -15 * 0.003, kz = 60 * 0.005;
  ExpectGains({kx, ky, kz});
  controller_.reference().v_WG.x() = 0.01;  // Pauses in the plane: a lag.
  ExpectGains({0, 0, kz});
  controller_.reference().v_WG.setZero();
  state_.v.segment<3>(3) << 0.03, 0, 0;  // Pauses while the robot moves.
  ExpectGains({0, 0, kz});
  // An error along z that decays as the gains predict, kd v = kp e.
  state_.v.segment<3>(3) << 0, 0, 3 * 0.005;
  ExpectGains({kx, ky, 0});
  state_.v.setZero();
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki", 0));
  Update();
  Update();
  EXPECT_LT(Correction().head<2>().norm(), 1e-7);
  EXPECT_GT(Correction().z(), 0.015);
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki_height", 0));
  Update();
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

// If the task com moves the center of mass, its integral gains are used.
TEST_F(CorrectionTest, UsesGainsOfComTask) {
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.Enable("momentum", false));
  ASSERT_TRUE(stack.Enable("com", true));
  ASSERT_TRUE(stack.SetParameter("com", "ki", 20));
  ASSERT_TRUE(stack.SetParameter("com", "ki_height", 40));
  controller_.reference().p_WG += Eigen::Vector3d(0.004, -0.003, 0.005);
  ExpectGains({20 * 0.004, -20 * 0.003, 40 * 0.005});
  // Pauses while the target is infeasible.
  controller_.Start(state_);
  controller_.reference().p_WG += Eigen::Vector3d(0, 0.5, 0.01);
  for (int i = 0; i < 5; ++i) Update();
  controller_.reference().p_WG -= Eigen::Vector3d(0, 0.5, 0.01);
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

TEST_F(CorrectionTest, PausesWhileMomentumTaskIsInfeasible) {
  controller_.reference().p_WG += Eigen::Vector3d(0, 0.5, 0.01);
  for (int i = 0; i < 5; ++i) Update();
  controller_.reference().p_WG -= Eigen::Vector3d(0, 0.5, 0.01);
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

// A residual that is due to a ramp is not integrated.
TEST_F(CorrectionTest, PausesWhileItsTaskIsEasedIn) {
  Stack& stack = controller_.stack();
  ASSERT_TRUE(stack.Enable("momentum", false));
  ASSERT_TRUE(stack.set_ramp(0.1));
  controller_.reference().p_WG.z() += 0.02;
  Update();
  ASSERT_TRUE(stack.Enable("momentum", true));
  for (int i = 0; i <= 100; ++i) Update();
  EXPECT_FALSE(stack.is_eased());
  // One tick is not eased and integrates; with all ticks the value would be
  // 0.12.
  EXPECT_LT(Correction().norm(), 1.1 * 60 * 0.02 * 1e-3);
}

TEST_F(CorrectionTest, IsClampedAndResetWithItsTask) {
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki", 100));
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "ki_height", 100));
  for (const double side : {1.0, -1.0}) {
    controller_.Start(state_);
    const Eigen::Vector3d e = side * Eigen::Vector3d(0.012, 0.016, 0.03);
    controller_.reference().p_WG += e;
    Update();
    EXPECT_LT(Correction().norm(), 1e-7);  // Start() resets it.
    Gained(600);
    EXPECT_LT(
        (Correction().head<2>() - side * Eigen::Vector2d(0.3, 0.4)).norm(),
        1e-6);
    EXPECT_NEAR(Correction().z(), side * 1.6, 1e-6);
  }
  ASSERT_TRUE(controller_.stack().Enable("momentum", false));
  Update();
  ASSERT_TRUE(controller_.stack().Enable("momentum", true));
  Update();
  EXPECT_LT(Correction().norm(), 1e-7);
}

}  // namespace
}  // namespace poise
