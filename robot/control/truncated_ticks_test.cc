// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Many ticks in a row that the budget cuts off, in a closed loop.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "poise/dynamics/integrate.h"
#include "poise/hqp/certificate.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/robot/control/bolted_down_fixture.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/controller_fixture.h"
#include "poise/robot/control/torque.h"

namespace poise {
namespace {

// The humanoid with its feet bolted down, and a controller whose clock can cut
// off each solve after two iterations, the fewest that a limit of time allows.
class TruncatedTicksTest : public ControllerTest {
 protected:
  TruncatedTicksTest() : hasty_(robot_, Options()), plant_(hasty_) {
    hasty_.Start(state_);
  }

  void Update(bool is_cut_off) {
    seconds_per_reading_ = is_cut_off ? 2 * kBudget : 0;
    state_.time += kDt;
    hasty_.Update(state_, &command_);
  }

  // Moves the robot by the torques of the command.
  void Simulate() {
    const Eigen::VectorXd no_push = Eigen::VectorXd::Zero(tree().nv());
    state_.v += kDt * plant_.Solve(command_.tau, no_push).head(tree().nv());
    Integrate(tree(), state_.q, state_.v, kDt, state_.q);
  }

  const TickReport& report() const { return hasty_.report(); }
  const Hierarchy& hierarchy() const { return hasty_.hierarchy(); }

  // Returns the answer of a solver that was never cut off, to the problem of
  // the last tick.
  Solution Optimum() const {
    const std::vector<LevelCapacity> capacity = hasty_.stack().capacity();
    Solution solution(hierarchy().num_variables(), capacity);
    Solver solver(hierarchy().num_variables(), capacity);
    EXPECT_EQ(solver.Solve(hierarchy(), &solution), Status::kOptimal);
    return solution;
  }

  void ExpectTruncatedReport() const;
  void ExpectLevelsAboveHold() const;
  void ExpectTorqueLimits() const;

  // A controller at 1 kHz [s]. Any other budget would do: the clock is made
  // here.
  static constexpr double kDt = 1e-3, kBudget = 1e-3;

  double seconds_ = 0, seconds_per_reading_ = 0;
  Controller hasty_;

 private:
  ControllerOptions Options() {
    ControllerOptions options;
    options.max_seconds = kBudget;
    options.now = [this] { return seconds_ += seconds_per_reading_; };
    return options;
  }

  BoltedDown plant_;
};

void TruncatedTicksTest::ExpectTruncatedReport() const {
  EXPECT_EQ(command_.status, TickStatus::kTruncated);
  EXPECT_EQ(report().status, TickStatus::kTruncated);
  EXPECT_EQ(report().solver_status, Status::kIterationLimit);
  EXPECT_EQ(report().fail_safe_reason, FailSafeReason::kNone);
  EXPECT_EQ(report().iterations, 2);
  EXPECT_GT(report().failed_level, 1);
  EXPECT_LE(report().certificate.worst(), Certifier::kCertified);
  // A row is reported for its own slack, or for the multiplier of a level with
  // an optimum.
  for (const ActiveRow& row : report().active) {
    if (row.pressing_level == report().tasks[row.task].level) continue;
    EXPECT_LT(row.pressing_level, report().failed_level)
        << hasty_.stack().RowName(row);
  }
}

// Compares the costs of the reported y with those of the optimum. The gap is a
// bound down to the failed level, where it is the whole cost.
void TruncatedTicksTest::ExpectLevelsAboveHold() const {
  const Solution optimum = Optimum();
  Solution reported = optimum;
  reported.y = report().y;
  for (int level = 0; level < hierarchy().num_levels(); ++level) {
    const int priority = hasty_.stack().priority_level(level);
    SCOPED_TRACE(priority);
    EvaluateLevel(hierarchy(), level, &reported);
    const double cost = reported.levels[level].cost;
    const double gap = report().gap[priority - 1];
    if (priority > report().failed_level) {
      EXPECT_TRUE(std::isinf(gap));
    } else if (priority == report().failed_level) {
      EXPECT_GT(cost, optimum.levels[level].cost);
      EXPECT_NEAR(gap, cost, Certifier::kCertified * cost);
    } else {
      EXPECT_LE(cost - optimum.levels[level].cost, gap);
      // These levels are met to rounding, and the gap is at most the cost: the
      // square of residuals that are far below 1e-4.
      EXPECT_LE(gap, 1e-9);
    }
  }
}

void TruncatedTicksTest::ExpectTorqueLimits() const {
  Eigen::VectorXd tau(tree().num_joints());
  ComputeTorque(hasty_.tick(), hasty_.contacts(), report().y, &tau);
  for (int j = 0; j < tree().num_joints(); ++j) {
    const double effort = robot_.model.limits[j].effort;
    EXPECT_LE(std::abs(command_.tau[j]), effort) << j;
    // The limits are on level 2. A solution meets a row to 1e-9 |C_i| |y|, and
    // |y| is below 1e3.
    if (report().failed_level > 2) {
      EXPECT_LE(std::abs(tau[j]), effort * (1 + 1e-6)) << j;
    }
  }
}

// The reference of the center of mass jumps in each tick, so that each search
// has to change many rows of the working set. After 24 such solves, one search
// starts from an empty working set.
TEST_F(TruncatedTicksTest, KeepTheLevelsAboveAndEndWithTheBudget) {
  Update(false);
  ASSERT_EQ(command_.status, TickStatus::kOk);
  constexpr int kTicks =
      30;  // More than the 24 after which a search starts over.
  int that_lose_momentum_only = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    SCOPED_TRACE(tick);
    hasty_.reference().p_WG.y() = tick % 2 == 0 ? 0.2 : -0.2;
    Update(true);
    ExpectTruncatedReport();
    ExpectLevelsAboveHold();
    ExpectTorqueLimits();
    that_lose_momentum_only += report().failed_level == 4;
    Simulate();
  }
  // Limits and feet come before momentum, but in the search from an empty
  // working set.
  EXPECT_GE(that_lose_momentum_only, kTicks - 1);
  Update(false);
  EXPECT_EQ(command_.status, TickStatus::kOk);
  EXPECT_EQ(report().failed_level, 0);
  const Solution optimum = Optimum();
  EXPECT_LE((report().y - optimum.y).norm(),
            Certifier::kCertified * optimum.y.norm());
}

}  // namespace
}  // namespace poise
