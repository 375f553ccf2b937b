// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/torque.h"

#include <gtest/gtest.h>

#include <cmath>

#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Joint 0 of this humanoid has damping 2, joint 1 dry friction 3; their motors
// have 10 N m.
Robot Dragged() {
  Robot robot = LoadHumanoid();
  robot.model.limits[0].damping = 2;
  robot.model.limits[1].friction = 3;
  robot.model.limits[0].effort = robot.model.limits[1].effort = 10;
  return robot;
}

// Returns the torques that are added to `tau` in all joints, which move with v
// and shall accelerate with vdot.
Eigen::VectorXd Added(const Robot& robot, double v, double vdot, double tau,
                      double scale = 1) {
  const int n = robot.model.tree.num_joints();
  Eigen::VectorXd torque = Eigen::VectorXd::Constant(n, tau);
  DragCompensation(robot).AddTo(scale, Eigen::VectorXd::Constant(n, v),
                                Eigen::VectorXd::Constant(n, vdot), &torque);
  return torque - Eigen::VectorXd::Constant(n, tau);
}

TEST(DragCompensation, LeavesJointsWithoutDragAlone) {
  EXPECT_TRUE(Added(Dragged(), 1, 2, 0.1).tail(10).isZero(0));
  EXPECT_TRUE(Added(LoadHumanoid(), 1, 2, 0.1).isZero(0));
}

TEST(DragCompensation, MeetsDampingAndFrictionOfAMovingJoint) {
  for (const double v : {0.8, -0.8}) {
    const Eigen::VectorXd added = Added(Dragged(), v, 0, 0);
    EXPECT_NEAR(added[0], 2 * v, 1e-12);
    // tanh(0.8 / v_0) is 1 to this number, as v_0 is below 0.05 rad/s.
    EXPECT_NEAR(added[1], std::copysign(3, v), 1e-6);
  }
}

TEST(DragCompensation, StartsAJointAtRestInTheWantedDirection) {
  EXPECT_NEAR(Added(Dragged(), 0, 10, 0)[1], 3, 1e-6);
  EXPECT_NEAR(Added(Dragged(), 0, -10, 0)[1], -3, 1e-6);
  EXPECT_EQ(Added(Dragged(), 0, 0, 0)[1], 0);
}

TEST(DragCompensation, NeverExceedsTheFriction) {
  for (double v = -0.2; v < 0.2; v += 0.013) {
    for (double vdot = -5; vdot < 5; vdot += 0.17) {
      EXPECT_LE(std::abs(Added(Dragged(), v, vdot, 0)[1]), 3);
    }
  }
}

// A braking joint still moves against its friction.
TEST(DragCompensation, FollowsTheVelocityOfAMovingJoint) {
  EXPECT_NEAR(Added(Dragged(), 0.8, -10, 0)[1], 3, 1e-6);
}

TEST(DragCompensation, StaysInsideTheLimitOfTheMotor) {
  EXPECT_NEAR(Added(Dragged(), 0.8, 0, 9)[1], 1, 1e-12);
  EXPECT_NEAR(Added(Dragged(), -0.8, 0, -9)[1], -1, 1e-12);
  EXPECT_NEAR(Added(Dragged(), 0.8, 0, 7, 0.8)[1], 1, 1e-12);
  // A torque of the controller beyond the limit is kept, so that it is
  // reported.
  EXPECT_EQ(Added(Dragged(), 0.8, 0, 12)[1], 0);
  EXPECT_NEAR(Added(Dragged(), -0.8, 0, 12)[1], -3, 1e-6);
}

}  // namespace
}  // namespace poise
