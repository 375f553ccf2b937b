// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests the fail-safe command, and ticks that the solver cannot solve, or not
// in time.
#include "poise/robot/control/fail_safe.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "poise/robot/control/bolted_down_fixture.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/controller_fixture.h"
#include "poise/robot/control/torque.h"

namespace poise {
namespace {

class FailSafeTest : public ControllerTest {
 protected:
  FailSafeReason Reason() const {
    return controller_.report().fail_safe_reason;
  }

  void ExpectInsideLimits() const {
    for (int j = 0; j < tree().num_joints(); ++j) {
      EXPECT_LE(std::abs(command_.tau[j]), robot_.model.limits[j].effort)
          << tree().joints()[j].name;
    }
  }
};

TEST_F(FailSafeTest, FailsSafeOnNaNAndInfinity) {
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (double* entry : {&state_.q[10], &state_.v[20], &state_.v[0]}) {
      const double good = *entry;
      *entry = bad;
      Update();
      EXPECT_EQ(command_.status, TickStatus::kFailSafe);
      EXPECT_EQ(Reason(), FailSafeReason::kState);
      EXPECT_TRUE(command_.tau.allFinite());
      ExpectInsideLimits();
      *entry = good;
    }
  }
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

TEST_F(FailSafeTest, ClearsReportOfEarlierTick) {
  // Limits become active, and targets are violated.
  controller_.reference().p_WG.y() += 0.2;
  Update();
  const TickReport& report = controller_.report();
  ASSERT_GT(report.y.norm(), 1);
  ASSERT_FALSE(report.lost.empty());
  state_.q[10] = std::numeric_limits<double>::quiet_NaN();
  Update();
  ASSERT_EQ(Reason(), FailSafeReason::kState);
  EXPECT_TRUE(report.y.isZero(0));
  EXPECT_EQ(report.y.size(), tree().nv() + 12);
  EXPECT_TRUE(report.active.empty() && report.lost.empty());
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.dynamics_residual, 0);
  EXPECT_EQ(report.certificate.worst(), 0);
  for (const TaskReport& task : report.tasks) {
    EXPECT_EQ(task.residual, 0);
    EXPECT_EQ(task.slack, 0);
  }
}

// Quaternions with a wrong norm are invalid. The torques then follow from the
// last valid state.
TEST_F(FailSafeTest, FailsSafeOnQuaternionWithWrongNorm) {
  Update();
  const Eigen::Vector4d good = state_.q.segment<4>(3);
  const auto fail_safe = [&](double norm, double rate) {
    state_.q.segment<4>(3) = norm * good;
    state_.v[20] = rate;
    Update();
    state_.q.segment<4>(3) = good;
    state_.v[20] = 0;
    EXPECT_EQ(command_.status, TickStatus::kFailSafe) << norm;
    return command_.tau;
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd held = fail_safe(1, none);
  for (const double norm : {0.0, 1e-170, 1e-5, 0.998, 1.002, 2.0}) {
    EXPECT_EQ(fail_safe(norm, 0), held) << norm;
    EXPECT_EQ(fail_safe(1, none), held) << norm;
  }
  // An error of the norm as from single precision is accepted.
  state_.q.segment<4>(3) = (1 + 1e-6) * good;
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

TEST_F(FailSafeTest, StartUsesLastValidStateIfStateIsInvalid) {
  Update();
  const Eigen::Vector3d p_WG = controller_.reference().p_WG;
  State bad = state_;
  bad.q.segment<4>(3).setZero();
  controller_.Start(bad);
  EXPECT_EQ(controller_.reference().p_WG, p_WG);
  controller_.Update(bad, &command_);
  EXPECT_EQ(command_.status, TickStatus::kFailSafe);
  EXPECT_TRUE(command_.tau.allFinite());
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

// The damping torque of a joint this fast overflows, and no effort limit clamps
// it.
TEST_F(FailSafeTest, NeverSendsTorqueThatIsNotFinite) {
  const int n = tree().num_joints();
  for (const double effort : {0.0, std::numeric_limits<double>::infinity()}) {
    robot_.model.limits[0].effort = effort;
    Controller controller(robot_);
    controller.Start(state_);
    state_.v.tail(n).setConstant(std::numeric_limits<double>::max());
    controller.Update(state_, &command_);
    EXPECT_EQ(command_.status, TickStatus::kFailSafe);
    EXPECT_TRUE(command_.tau.allFinite()) << effort;
    EXPECT_EQ(command_.tau[0], 0);
    state_.v.setZero();
  }
}

TEST_F(FailSafeTest, FailSafeTorqueBalancesGravity) {
  Update();
  state_.q[10] = std::numeric_limits<double>::quiet_NaN();
  Update();
  const Eigen::VectorXd rest =
      BoltedDown(controller_)
          .Solve(command_.tau, Eigen::VectorXd::Zero(tree().nv()));
  // m/s2 and rad/s2: rounding, divided by the small inertia of the fingers.
  EXPECT_LT(rest.head(tree().nv()).norm(), 1e-5);
}

// In motion, the torque is gravity compensation plus damping by the inertia of
// each joint. The list of active rows is cleared.
TEST_F(FailSafeTest, FailSafeTorqueDampsEachJoint) {
  Update();
  const double q = state_.q[10];
  const auto fail_safe = [&] {
    state_.q[10] = std::numeric_limits<double>::quiet_NaN();
    Update();
    state_.q[10] = q;
    EXPECT_EQ(command_.status, TickStatus::kFailSafe);
    EXPECT_TRUE(controller_.report().active.empty());
    return command_.tau;
  };
  const Eigen::VectorXd at_rest = fail_safe();
  const int n = tree().num_joints();
  for (int j = 0; j < n; ++j) state_.v[6 + j] = 0.02 * (j % 5 - 2);
  state_.v.head<3>() << 0.3, -0.4, 0.2;
  Update();
  const Eigen::VectorXd braked = fail_safe();
  for (int j = 0; j < n; ++j) {
    const double M = controller_.tick().M(6 + j, 6 + j);
    EXPECT_NEAR(braked[j], at_rest[j] - 10 * M * state_.v[6 + j], 1e-9) << j;
  }
}

TEST_F(FailSafeTest, FailSafeTorqueUsesFeetInContactOnly) {
  Update();
  std::vector<ContactTick> contacts = controller_.contacts();
  contacts[1].in_contact = false;
  const int n = tree().num_joints();
  const Tick& tick = controller_.tick();
  Eigen::VectorXd tau(n);
  ComputeFailSafeTorque(tick, contacts, Eigen::VectorXd::Zero(n), 10, &tau);
  // The leg in the air has the torques of gravity only.
  int joints = 0;
  for (int j = 0; j < n; ++j) {
    if (contacts[1].J_WC_C.col(6 + j).norm() < 1e-9) continue;
    EXPECT_NEAR(tau[j], tick.N[6 + j], 1e-9);
    ++joints;
  }
  EXPECT_EQ(joints, 6);
  // A joint whose rate is NaN is not damped.
  Eigen::VectorXd v = Eigen::VectorXd::Constant(n, 0.1);
  v[3] = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd braked(n);
  ComputeFailSafeTorque(tick, contacts, v, 10, &braked);
  EXPECT_EQ(braked[3], tau[3]);
  EXPECT_NEAR(braked[4], tau[4] - tick.M(10, 10), 1e-9);
}

TEST_F(FailSafeTest, FailsSafeWhileClockIsFrozen) {
  Update();
  for (int i = 1; i <= 20; ++i) {
    controller_.Update(state_, &command_);
    EXPECT_EQ(command_.status == TickStatus::kFailSafe, i > 10) << i << " ms";
    EXPECT_EQ(Reason(),
              i > 10 ? FailSafeReason::kClock : FailSafeReason::kNone);
  }
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
  EXPECT_EQ(Reason(), FailSafeReason::kNone);
}

// Up to 10 ms of invalid states with a frozen clock, the reason is the state;
// afterwards, the reason is the clock.
TEST_F(FailSafeTest, ReportsClockOnlyAfterTenMilliseconds) {
  Update();
  for (int i = 1; i <= 12; ++i) {
    State state = state_;
    if (i >= 9) state.q[10] = std::numeric_limits<double>::quiet_NaN();
    controller_.Update(state, &command_);
    EXPECT_EQ(Reason(), i < 9     ? FailSafeReason::kNone
                        : i <= 10 ? FailSafeReason::kState
                                  : FailSafeReason::kClock)
        << i << " ms";
  }
}

TEST_F(FailSafeTest, StartResetsTheClock) {
  for (int i = 0; i < 100; ++i) Update();
  for (int i = 0; i < 20; ++i) controller_.Update(state_, &command_);
  ASSERT_EQ(command_.status, TickStatus::kFailSafe);
  state_.time = 0;
  controller_.Start(state_);
  for (int i = 0; i < 50; ++i) {
    Update();
    ASSERT_EQ(command_.status, TickStatus::kOk) << i;
  }
}

// A time stamp that jumps does not fail safe. A time stamp that is not finite
// fails safe in its own tick only. Afterwards, a frozen clock is still
// detected.
TEST_F(FailSafeTest, ContinuesAfterWrongTimeStamp) {
  Update();
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {3600.0, -3600.0, infinity, -infinity, none}) {
    State stamped = state_;
    stamped.time = wrong;
    controller_.Update(stamped, &command_);
    EXPECT_EQ(command_.status == TickStatus::kFailSafe, !std::isfinite(wrong));
    for (int i = 0; i < 30; ++i) {
      Update();
      ASSERT_EQ(command_.status, TickStatus::kOk) << wrong << ", " << i;
    }
    for (int i = 1; i <= 12; ++i) {
      controller_.Update(state_, &command_);
      ASSERT_EQ(command_.status == TickStatus::kFailSafe, i > 10) << i;
    }
  }
}

TEST_F(FailSafeTest, FailsSafeWhenDynamicsWouldOverflow) {
  Update();
  state_.v.setConstant(1e200);
  Update();
  EXPECT_EQ(command_.status, TickStatus::kFailSafe);
  EXPECT_TRUE(command_.tau.allFinite());
  ExpectInsideLimits();
}

TEST_F(FailSafeTest, TruncatesAtIterationLimit) {
  ControllerOptions options;
  options.max_iterations = 1;
  Controller hasty(robot_, options);
  hasty.Start(state_);
  // A push: rows become active that were inactive before.
  state_.v.segment<3>(3) << 0, 0.6, 0;
  state_.time = 1e-3;
  hasty.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kTruncated);
  EXPECT_GT(hasty.report().failed_level, 1);
  ExpectInsideLimits();
  const int newton_euler = *hasty.stack().Find("newton_euler");
  EXPECT_LT(hasty.report().tasks[newton_euler].residual, 1e-9);
}

// The clock of this test advances by 0.4 ms with each reading: the budget
// suffices for four factorisations.
TEST_F(FailSafeTest, StopsAtTimeLimit) {
  double seconds = 0;
  ControllerOptions options;
  options.max_seconds = 1e-3;
  options.now = [&seconds] { return seconds += 0.4e-3; };
  Controller hasty(robot_, options);
  hasty.Start(state_);
  state_.v.segment<3>(3) << 0, 0.6, 0;
  state_.time = 1e-3;
  hasty.Update(state_, &command_);
  EXPECT_TRUE(command_.status == TickStatus::kTruncated ||
              command_.status == TickStatus::kFailSafe);
  EXPECT_LE(hasty.report().iterations, 4);
  EXPECT_TRUE(command_.tau.allFinite());
  ExpectInsideLimits();
}

// Torques of an impossible motion are worse than the fail-safe torques. Control
// continues when a solution meets the dynamics again.
TEST_F(FailSafeTest, FailsSafeIfDynamicsAreNotMet) {
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  EXPECT_LT(controller_.report().dynamics_residual, 1e-9);
  State bad = state_;
  bad.q[10] = std::numeric_limits<double>::quiet_NaN();
  bad.time += 1e-3;
  controller_.Update(bad, &command_);
  const Eigen::VectorXd held = command_.tau;
  Stack& stack = controller_.stack();
  const auto expect_held = [&] {
    for (int i = 0; i < 3; ++i) {
      Update();
      EXPECT_EQ(command_.status, TickStatus::kFailSafe);
      EXPECT_GT(controller_.report().dynamics_residual, 1e-6);
    }
  };
  ASSERT_TRUE(stack.Enable("newton_euler", false));
  expect_held();
  EXPECT_EQ(command_.tau, held);
  ASSERT_TRUE(stack.Enable("newton_euler", true));
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
  EXPECT_LT(controller_.report().dynamics_residual, 1e-9);

  // Contacts and torque limits on higher levels make the dynamics infeasible.
  ASSERT_TRUE(stack.SetParameter("torque_limits", "scale", 0.05));
  ASSERT_TRUE(stack.SetLevel("torque_limits", 1));
  ASSERT_TRUE(stack.SetLevel("newton_euler", 4));
  expect_held();
  ExpectInsideLimits();
  // With the dynamics on level 1 again, the contact rows are violated: the
  // robot sinks, within its torque limits.
  ASSERT_TRUE(stack.SetLevel("newton_euler", 1));
  ASSERT_TRUE(stack.SetLevel("torque_limits", 2));
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
  EXPECT_LT(controller_.report().dynamics_residual, 1e-9);
}

// The residual is relative to the sum of all terms, or to the scale if that is
// larger.
TEST_F(FailSafeTest, DynamicsResidualIsRelativeToTermsOrScale) {
  Update();
  const Tick& tick = controller_.tick();
  const auto& contacts = controller_.contacts();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(controller_.report().y.size());
  const auto residual = [&](double scale) {
    return DynamicsResidual(tick, contacts, y, scale);
  };
  const double all = tick.N.head<6>().lpNorm<1>();
  EXPECT_DOUBLE_EQ(residual(0), 1);
  EXPECT_DOUBLE_EQ(residual(2 * all), 0.5);
  y = controller_.report().y;
  EXPECT_LT(residual(0), 1e-12);
  // 1 mN more on the left foot, with its moments about the base.
  y[tree().nv() + 5] += 1e-3;
  const double off = contacts[0].J_WC_C.row(5).head<6>().lpNorm<1>() * 1e-3;
  EXPECT_NEAR(residual(10 * all), off / (10 * all), 1e-12);
  // 1 mm/s2 more acceleration of the base.
  y = controller_.report().y;
  y[4] += 1e-3;
  EXPECT_NEAR(residual(10 * all),
              tick.M.col(4).head<6>().lpNorm<1>() * 1e-4 / all, 1e-12);
  y[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(residual(all) <= 1);
}

TEST_F(FailSafeTest, FailsSafeIfFirstLevelIsNotSolved) {
  // The torque limits share the first level, and cannot be met in one step.
  ControllerOptions options;
  options.max_iterations = 1;
  Controller late(robot_, options);
  ASSERT_TRUE(late.stack().SetLevel("torque_limits", 1));
  ASSERT_TRUE(late.stack().SetParameter("torque_limits", "scale", 0.05));
  late.Start(state_);
  state_.time = 1e-3;
  late.Update(state_, &command_);
  EXPECT_EQ(late.report().failed_level, 1);
  EXPECT_EQ(late.report().fail_safe_reason, FailSafeReason::kNoAnswer);
  EXPECT_EQ(command_.status, TickStatus::kFailSafe);
  ExpectInsideLimits();
}

}  // namespace
}  // namespace poise
