// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that the controller does not turn the feet before they touch the
// ground.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/dynamics/aba.h"
#include "poise/robot/control/controller_fixture.h"

namespace poise {
namespace {

class FirstTouchTest : public ControllerTest {
 protected:
  // Starts with the floor where the nominal soles are, and the robot above.
  void StartAbove(double height) {
    state_.time = 0;
    state_.q[2] = robot_.q_nominal[2];
    controller_.Start(state_);
    state_.q[2] += height;
  }

  double share() const { return controller_.contacts()[0].wrench_share; }

  // Returns the angular accelerations of the soles if nothing touches them.
  Eigen::Matrix<double, 6, 1> Turning() {
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(tree().nv());
    tau.tail(tree().num_joints()) = command_.tau;
    Eigen::VectorXd vdot(tree().nv());
    AbaScratch scratch(tree());
    EXPECT_EQ(ComputeAba(tree(), state_.q, state_.v, tau,
                         std::vector<SpatialForce>(tree().num_bodies()),
                         &scratch, vdot),
              AbaStatus::kOk);
    Eigen::Matrix<double, 6, 1> turning;
    for (int foot = 0; foot < 2; ++foot) {
      const ContactTick& contact = controller_.contacts()[foot];
      turning.segment<3>(3 * foot) =
          (contact.J_WC_C * vdot + contact.Jdot_v_C).head<3>();
    }
    return turning;
  }
};

TEST_F(FirstTouchTest, AllowsAllOfTheWrenchOnTheGround) {
  StartAbove(0);
  Update();
  EXPECT_EQ(share(), 1);
}

TEST_F(FirstTouchTest, RestrictsTheWrenchUntilAFootTouches) {
  StartAbove(0.002);
  for (int i = 1; i <= 10; ++i) {
    state_.v[5] = -9.81e-3 * i;  // The robot falls.
    Update();
    EXPECT_TRUE(controller_.contacts()[0].in_contact);
    EXPECT_LT(share(), 0.2) << i;
  }
  state_.q[2] = robot_.q_nominal[2];
  Update();
  EXPECT_EQ(share(), 1);
  state_.q[2] += 0.002;  // A sole that bounces has touched.
  Update();
  EXPECT_EQ(share(), 1);
  StartAbove(0.002);
  state_.v[5] = 0;
  Update();
  EXPECT_LT(share(), 0.2);
}

// The floor is 3 mm higher than its estimate: the soles rest above the
// estimate.
TEST_F(FirstTouchTest, FindsGroundThatIsHigherThanItsEstimate) {
  StartAbove(0.003);
  for (int i = 0; i < 10; ++i) Update();
  EXPECT_EQ(share(), 1);
}

// To stop a fall, the CoP would be at the edges of the soles, with friction and
// a yaw moment. In the air, this wrench would turn the feet. The moment of the
// vertical force about the foot's center of mass remains, so the feet turn more
// slowly by 3 times, not by 10.
TEST_F(FirstTouchTest, HardlyTurnsFeetInTheAir) {
  state_.v.segment<6>(0) << 0.5, 0.5, 1, 0.3, 0.2, 0;
  StartAbove(0);
  Update();
  const double if_on_ground = Turning().norm();
  StartAbove(0.002);
  Update();
  EXPECT_LT(Turning().norm(), if_on_ground / 3);
}

}  // namespace
}  // namespace poise
