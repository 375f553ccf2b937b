// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests which feet the controller treats as in contact when a foot loses the
// ground, is released or is lifted.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "poise/robot/control/controller_fixture.h"

namespace poise {
namespace {

// Both feet lose the ground: the robot is in flight, and its legs move with the
// body. The robot stands again as soon as the feet touch the ground.
TEST_F(ControllerTest, DetectsLossOfGround) {
  Update();
  ASSERT_EQ(controller_.stance().phase(0), ContactPhase::kDown);
  const double ground = controller_.reference().ground_z;
  controller_.reference().ground_z = ground - 0.03;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(controller_.stance().phase(0), ContactPhase::kDown);
    Update();
  }
  EXPECT_EQ(controller_.stance().phase(0), ContactPhase::kLost);
  EXPECT_FALSE(controller_.contacts()[0].in_contact);
  EXPECT_NE(command_.status, TickStatus::kFailSafe);
  EXPECT_LT(controller_.report().foot_wrench(tree().nv(), 0).norm(), 1e-9);
  // In free fall, with the joints at rest in the posture, no joint accelerates.
  const int n = tree().num_joints();
  EXPECT_LT(controller_.report().y.segment(6, n).lpNorm<Eigen::Infinity>(),
            1e-9);
  controller_.reference().ground_z = ground;
  Update();
  EXPECT_EQ(controller_.stance().phase(0), ContactPhase::kDown);
  EXPECT_GT(controller_.report().foot_wrench(tree().nv(), 0)[5], 100);
}

// In a fall to one side, the foot on the other side is unloaded and is
// released. The foot comes back when the robot is slow and has its reference
// orientation, or when the robot falls to the side of the foot. Here the foot
// is still on the ground, so contact is found at once.
TEST_F(ControllerTest, ReleasesFootUnloadedByFall) {
  for (const int side : {1, -1}) {
    const int away = side > 0 ? 1 : 0;
    const auto phase_at = [&](double speed, double yaw) {
      state_.v[4] = speed * side;
      state_.q.segment<4>(3) << 0, 0, std::sin(yaw / 2), std::cos(yaw / 2);
      Update();
      return controller_.stance().phase(away);
    };
    controller_.Start(state_);
    EXPECT_EQ(phase_at(0.4, 0), ContactPhase::kDown);
    EXPECT_LT(controller_.report().foot_wrench(tree().nv(), away)[5], 1);
    EXPECT_EQ(phase_at(0.4, 0), ContactPhase::kDown);
    EXPECT_EQ(phase_at(0.6, 0), ContactPhase::kFree);
    EXPECT_EQ(controller_.stance().phase(1 - away), ContactPhase::kDown);
    EXPECT_FALSE(controller_.contacts()[away].in_contact);
    EXPECT_LT(controller_.report().foot_wrench(tree().nv(), away).norm(), 1e-9);
    EXPECT_EQ(command_.status, TickStatus::kOk);
    const int swing =
        *controller_.stack().Find("frame." + robot_.feet[away].name);
    EXPECT_EQ(controller_.report().tasks[swing].residual, 0);

    EXPECT_EQ(phase_at(0.35, 0), ContactPhase::kFree);
    EXPECT_EQ(phase_at(0.25, 0.45), ContactPhase::kFree);
    EXPECT_EQ(phase_at(0.25, 0), ContactPhase::kLoading);

    controller_.Start(state_);
    EXPECT_EQ(phase_at(0.4, 0), ContactPhase::kDown);
    EXPECT_EQ(phase_at(0.6, 0), ContactPhase::kFree);
    EXPECT_EQ(phase_at(-0.4, 0), ContactPhase::kLoading);
    state_.v.setZero();
  }
}

TEST_F(ControllerTest, ReleasesNoFootWithoutCapture) {
  ASSERT_TRUE(controller_.stack().SetParameter("momentum", "capture", 0));
  state_.v[4] = 0.6;
  for (int i = 0; i < 3; ++i) Update();
  EXPECT_EQ(controller_.stance().phase(1), ContactPhase::kDown);
}

TEST_F(ControllerTest, FadesForceOutBeforeLift) {
  Update();
  ASSERT_TRUE(controller_.stance().Lift(1, 0.05));
  double last = std::numeric_limits<double>::infinity();
  while (controller_.stance().phase(1) != ContactPhase::kUp) {
    Update();
    const double limit = controller_.contacts()[1].max_normal_force;
    if (controller_.stance().phase(1) == ContactPhase::kUnloading) {
      EXPECT_LT(limit, last);
      last = limit;
    }
    ASSERT_LT(state_.time, 1);
  }
  EXPECT_LT(controller_.report().foot_wrench(tree().nv(), 1).norm(), 1e-9);
}

}  // namespace
}  // namespace poise
