// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/torque.h"

#include <gtest/gtest.h>

#include <cmath>

#include "poise/tests/util/count_malloc.h"
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

// Returns the torques that are added to `tau` in all joints, which move with v,
// after they were to accelerate with vdot for some ticks of 1 ms.
Eigen::VectorXd Added(const Robot& robot, double v, double vdot, double tau,
                      double scale = 1, int ticks = 10000) {
  const int n = robot.model.tree.num_joints();
  const Eigen::VectorXd velocity = Eigen::VectorXd::Constant(n, v);
  const Eigen::VectorXd acceleration = Eigen::VectorXd::Constant(n, vdot);
  DragCompensation drag(robot);
  Eigen::VectorXd torque;
  for (int k = 0; k < ticks; ++k) {
    torque = Eigen::VectorXd::Constant(n, tau);
    drag.AddTo(1e-3, scale, velocity, acceleration, &torque);
  }
  return torque - Eigen::VectorXd::Constant(n, tau);
}

TEST(DragCompensation, LeavesJointsWithoutDragAlone) {
  EXPECT_TRUE(Added(Dragged(), 1, 2, 0.1).tail(10).isZero(0));
  EXPECT_TRUE(Added(LoadHumanoid(), 1, 2, 0.1).isZero(0));
}

TEST(DragCompensation, MeetsTheDampingOfAMovingJoint) {
  EXPECT_NEAR(Added(Dragged(), 0.8, 0, 0)[0], 1.6, 1e-12);
  EXPECT_NEAR(Added(Dragged(), -0.8, 3, 0)[0], -1.6, 1e-12);
}

// At 10 rad/s2 the hyperbolic tangent is 1 to this number.
TEST(DragCompensation, MeetsTheFrictionOfTheWantedMotion) {
  EXPECT_NEAR(Added(Dragged(), 0, 10, 0)[1], 3, 1e-6);
  EXPECT_NEAR(Added(Dragged(), 0, -10, 0)[1], -3, 1e-6);
  EXPECT_EQ(Added(Dragged(), 0, 0, 0)[1], 0);
}

// A torque in the direction of the measured velocity would drive a joint whose
// friction is smaller than the file says.
TEST(DragCompensation, DoesNotFollowTheMeasuredVelocity) {
  EXPECT_EQ(Added(Dragged(), 0.8, 0, 0)[1], 0);
  EXPECT_EQ(Added(Dragged(), -0.8, 10, 0)[1], Added(Dragged(), 0, 10, 0)[1]);
}

TEST(DragCompensation, NeverExceedsTheFriction) {
  for (const double vdot : {-1e6, -1., -1e-3, 1e-3, 0.1, 1., 1e6}) {
    EXPECT_LE(std::abs(Added(Dragged(), 0, vdot, 0)[1]), 3) << vdot;
  }
}

// Noise of 2 rad/s2 in one tick moves the torque by a few percent of f.
TEST(DragCompensation, FiltersTheAcceleration) {
  EXPECT_GT(Added(Dragged(), 0, 2, 0, 1, 1)[1], 0);
  EXPECT_LT(Added(Dragged(), 0, 2, 0, 1, 1)[1], 0.1);
}

TEST(DragCompensation, ForgetsTheAccelerationByReset) {
  const Robot robot = Dragged();
  const int n = robot.model.tree.num_joints();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd tau = zero;
  DragCompensation drag(robot);
  drag.AddTo(1e-3, 1, zero, Eigen::VectorXd::Ones(n), &tau);
  EXPECT_GT(tau[1], 0);
  drag.Reset();
  tau = zero;
  drag.AddTo(1e-3, 1, zero, zero, &tau);
  EXPECT_EQ(tau[1], 0);
}

TEST(DragCompensation, StaysInsideTheLimitOfTheMotor) {
  EXPECT_NEAR(Added(Dragged(), 0, 10, 9)[1], 1, 1e-12);
  EXPECT_NEAR(Added(Dragged(), 0, -10, -9)[1], -1, 1e-12);
  EXPECT_NEAR(Added(Dragged(), 0, 10, 7, 0.8)[1], 1, 1e-12);
  // A torque of the controller beyond the limit is kept, so that it is
  // reported.
  EXPECT_EQ(Added(Dragged(), 0, 10, 12)[1], 0);
  EXPECT_NEAR(Added(Dragged(), 0, -10, 12)[1], -3, 1e-6);
}

TEST(DragCompensation, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  const Robot robot = Dragged();
  const Eigen::VectorXd ones =
      Eigen::VectorXd::Ones(robot.model.tree.num_joints());
  Eigen::VectorXd tau = ones;
  DragCompensation drag(robot);
  const CountMalloc count;
  drag.AddTo(1e-3, 1, ones, ones, &tau);
  drag.Reset();
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_NE(tau, ones);
}

}  // namespace
}  // namespace poise
