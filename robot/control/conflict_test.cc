// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests how the controller reports infeasible limits and lost targets, and how
// FindConflict() finds contradicting rows.
#include "poise/robot/control/conflict.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/controller_fixture.h"

namespace poise {
namespace {

// All joints run into their stops, and the motors are too weak. Torque limits
// are violated too, and the name of each row ends with the violated side.
TEST_F(ControllerTest, ReportsTorqueLimitThatIsInfeasible) {
  constexpr double kEffort = 0.01;  // N m.
  for (int j = 0; j < tree().num_joints(); ++j) {
    state_.q[7 + j] = robot_.model.limits[j].upper - 0.01;
    state_.v[6 + j] = 3;
    robot_.model.limits[j].effort = kEffort;
  }
  const auto slack = [&](const std::function<void(Stack*)>& change) {
    Controller weak(robot_);
    weak.Start(state_);
    change(&weak.stack());
    state_.time += 1e-3;
    weak.Update(state_, &command_);
    EXPECT_EQ(command_.status, TickStatus::kLimitRelaxed);
    int named = 0;
    for (const ActiveRow& row : weak.report().active) {
      const std::string name = weak.stack().RowName(row);
      if (name.rfind("torque.", 0) != 0 || row.slack < 1e-3) continue;
      EXPECT_EQ(name, "torque." + tree().joints()[row.row].name +
                          (command_.tau[row.row] > 0 ? ".max" : ".min"));
      ++named;
    }
    const int limits = *weak.stack().Find("torque_limits");
    EXPECT_EQ(named > 0, weak.report().tasks[limits].slack > 1e-3);
    return weak.report().tasks[limits].slack;
  };
  const double plain = slack([](Stack*) {});
  EXPECT_GT(plain, 1e-3);
  // A common weight on the whole level changes nothing, not even the unit.
  const double heavy = slack([](Stack* stack) {
    EXPECT_TRUE(stack->SetWeight("torque_limits", 4));
    EXPECT_TRUE(stack->SetWeight("joint_limits", 4));
  });
  EXPECT_NEAR(heavy, plain, 1e-6 * plain);
  // With the limit tasks off, the torque is clamped, and this is reported.
  EXPECT_EQ(slack([](Stack* stack) {
              EXPECT_TRUE(stack->Enable("torque_limits", false));
              EXPECT_TRUE(stack->Enable("joint_limits", false));
              EXPECT_TRUE(stack->SetParameter("torque_limits", "scale", 0.5));
            }),
            0);
  EXPECT_NEAR(command_.tau.cwiseAbs().maxCoeff(), 0.5 * kEffort, 1e-15);
}

// The torque limits are on a higher level and are met. A joint limit is
// violated, and this is reported.
TEST_F(ControllerTest, ReportsJointLimitThatIsInfeasible) {
  for (int j = 0; j < tree().num_joints(); ++j) {
    state_.q[7 + j] = robot_.model.limits[j].upper - 0.01;
    state_.v[6 + j] = 3;
    robot_.model.limits[j].effort = 20;
  }
  Controller weak(robot_);
  weak.Start(state_);
  ASSERT_TRUE(weak.stack().SetLevel("joint_limits", 3));
  state_.time = 1e-3;
  weak.Update(state_, &command_);
  EXPECT_LT(weak.report().tasks[*weak.stack().Find("torque_limits")].slack,
            1e-9);
  const int joint_limits = *weak.stack().Find("joint_limits");
  EXPECT_GT(weak.report().tasks[joint_limits].slack, 1e-3);
  ASSERT_TRUE(weak.report().relaxed);
  EXPECT_EQ(weak.report().relaxed->task, joint_limits);
  EXPECT_EQ(weak.report().relaxed->slack,
            weak.report().tasks[joint_limits].slack);
  EXPECT_EQ(command_.status, TickStatus::kLimitRelaxed);
}

// The target of the center of mass needs more acceleration to the left than the
// feet allow.
TEST_F(ControllerTest, ReportsLostTargetAndBindingLimit) {
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "capture", 0));
  controller_.reference().p_WG.y() += 0.2;
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  const Tick& tick = controller_.tick();
  const double mass = tree().total_mass();
  const double got =
      (tick.H_G.row(4).dot(controller_.report().y.head(tree().nv())) +
       tick.H_G_bias[4]) /
      mass;
  const int momentum = *controller_.stack().Find("momentum");
  double lost = 0;
  for (const LostRow& row : controller_.report().lost) {
    if (row.task == momentum && row.row == 4) lost = row.amount;
  }
  // N: the target acceleration is 0.2 m times kp.
  EXPECT_NEAR(lost, mass * (got - 30 * 0.2), 1e-6);
  EXPECT_LT(lost, -10);
  bool is_at_its_edge = false;
  for (const ActiveRow& row : controller_.report().active) {
    if (controller_.stack().RowName(row) != "right_foot.cop.y_min") continue;
    is_at_its_edge = row.pressing_level == 4 && row.multiplier > 0.01 &&
                     row.side == Side::kUpper && row.slack < 1e-9;
  }
  EXPECT_TRUE(is_at_its_edge);
}

// All joints run into their stops, with motors too weak to hold them.
TEST_F(ControllerTest, NamesInfeasibleLimitAndConflictingRows) {
  for (int j = 0; j < tree().num_joints(); ++j) {
    state_.q[7 + j] = robot_.model.limits[j].upper - 0.01;
    state_.v[6 + j] = 3;
    robot_.model.limits[j].effort = 0.01;
  }
  Controller weak(robot_);
  weak.Start(state_);
  state_.time = 1e-3;
  weak.Update(state_, &command_);
  EXPECT_EQ(command_.status, TickStatus::kLimitRelaxed);
  ASSERT_TRUE(weak.report().relaxed);
  const ActiveRow relaxed = *weak.report().relaxed;
  const std::string limit = weak.stack().RowName(relaxed);
  const std::string joint = tree().joints()[relaxed.row].name;
  EXPECT_TRUE(limit == "torque." + joint + ".max" ||
              limit == "torque." + joint + ".min" ||
              limit == "joint." + joint + ".max")
      << limit;
  bool is_named = false;
  for (const ActiveRow& row : weak.report().active) {
    if (weak.report().tasks[row.task].level != 2) continue;
    EXPECT_LE(row.slack, relaxed.slack * (1 + 1e-6));
    is_named |=
        row.slack > 1e-3 && weak.stack().RowName(row).rfind("joint.", 0) == 0;
  }
  EXPECT_TRUE(is_named);

  // Priority level 2 is index 1 of the hierarchy. Its rows contradict rows of
  // level 2 or 1.
  int joints = 0, upper = 0, torques = 0;
  for (const HierarchyRow& row : FindConflict(weak.hierarchy(), 1)) {
    const std::string name =
        weak.stack().RowName(row.level, row.row, row.equality, row.side);
    joints += name.rfind("joint.", 0) == 0;
    torques += name.rfind("torque.", 0) == 0;
    upper += name.rfind("joint.", 0) == 0 && row.side == Side::kUpper;
  }
  EXPECT_GT(joints, 0);
  EXPECT_GT(upper, 0);  // The stops of the joints.
  EXPECT_GT(torques, 0);
  EXPECT_LT(joints + torques, 2 * tree().num_joints());
}

TEST_F(ControllerTest, FindConflictReturnsContradictingRows) {
  // x <= -1 and x >= 1; y <= 5 does not matter.
  Hierarchy hierarchy(2, {{1, 3}});
  hierarchy.Clear(1);
  InequalityBlock rows = hierarchy.AddInequalities(0, 3);
  rows.C << 1, 0, 1, 0, 0, 1;
  rows.upper[0] = -1;
  rows.lower[1] = 1;
  rows.upper[2] = 5;
  const std::vector<HierarchyRow> conflict = FindConflict(hierarchy, 0);
  ASSERT_EQ(conflict.size(), 2u);
  EXPECT_EQ(conflict[0].row, 0);
  EXPECT_EQ(conflict[0].side, Side::kUpper);
  EXPECT_EQ(conflict[1].row, 1);
  EXPECT_EQ(conflict[1].side, Side::kLower);
}

// For two-sided rows, `side` is the bound that causes the conflict.
TEST_F(ControllerTest, FindConflictReturnsContradictingSides) {
  // -1 <= x <= 1, 2 <= x + y <= 9, and y = 0.
  Hierarchy hierarchy(2, {{1, 2}, {1, 0}});
  hierarchy.Clear(2);
  InequalityBlock rows = hierarchy.AddInequalities(0, 2);
  rows.C << 1, 0, 1, 1;
  rows.lower << -1, 2;
  rows.upper << 1, 9;
  EqualityBlock equal = hierarchy.AddEqualities(1, 1);
  equal.B << 0, 1;
  const std::vector<HierarchyRow> conflict = FindConflict(hierarchy, 1);
  ASSERT_EQ(conflict.size(), 3u);
  EXPECT_EQ(conflict[0].side, Side::kUpper);
  EXPECT_EQ(conflict[1].side, Side::kLower);
  EXPECT_TRUE(conflict[2].equality);
  EXPECT_EQ(conflict[2].side, Side::kNone);
}

TEST_F(ControllerTest, FindConflictReturnsNothingIfFeasible) {
  Update();
  EXPECT_TRUE(FindConflict(controller_.hierarchy(), 2).empty());
}

}  // namespace
}  // namespace poise
