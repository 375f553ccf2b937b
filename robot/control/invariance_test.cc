// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that the torques do not depend on the position and heading of the
// robot, and that a mirrored state gives mirrored torques.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "poise/math/so3.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/controller_fixture.h"

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Evaluates the controller in a general state: joints move, feet are not flat,
// and the push is so large that the capture blend is active and a foot is
// released.
class InvarianceTest : public ControllerTest {
 protected:
  InvarianceTest() {
    for (int j = 0; j < tree().num_joints(); ++j) {
      state_.q[7 + j] += 0.01 * std::sin(1.3 * j);
      state_.v[6 + j] = 0.1 * std::sin(1.7 * j);
    }
    state_.v.head<6>() << 0.1, -0.05, 0.02, 0.2, 0.6, 0;
  }

  // Runs a few ticks in one state, so that internal states of the controller
  // count.
  Command Answer(const State& state) {
    Controller controller(robot_);
    EXPECT_TRUE(controller.stack().Enable("capture_point", with_boxes_));
    EXPECT_TRUE(controller.stack().Enable("zmp", with_boxes_));
    State now = state;
    controller.Start(now);
    Command command;
    command.tau.setZero(tree().num_joints());
    for (int i = 1; i <= 5; ++i) {
      now.time = 1e-3 * i;
      controller.Update(now, &command);
      EXPECT_EQ(command.status, TickStatus::kOk);
    }
    let_go_ = 0;
    for (const int foot : {0, 1}) {
      let_go_ += controller.stance().phase(foot) == ContactPhase::kFree;
    }
    return command;
  }

  bool with_boxes_ = true;
  int let_go_ = 0;
  const double kSame = 1e-9;  // Relative tolerance of the torques.
};

TEST_F(InvarianceTest, TurnedAndMovedInputGivesTheSameTorques) {
  const Eigen::VectorXd tau = Answer(state_).tau;
  for (const double turn : {0.5, kPi / 2, 3.0}) {
    SCOPED_TRACE(turn);
    const Eigen::Matrix3d R = ExpSo3(Eigen::Vector3d(0, 0, turn));
    State moved = state_;
    const Eigen::Vector3d p(20, -30, 3);
    moved.q.head<3>() = p + R * state_.q.head<3>();
    const Eigen::Quaterniond q_WB(state_.q[6], state_.q[3], state_.q[4],
                                  state_.q[5]);
    moved.q.segment<4>(3) =
        Eigen::Quaterniond(R * q_WB.toRotationMatrix()).coeffs();
    moved.v.segment<3>(0) = R * state_.v.segment<3>(0);
    moved.v.segment<3>(3) = R * state_.v.segment<3>(3);
    EXPECT_LT((Answer(moved).tau - tau).norm(), kSame * tau.norm());
    moved.q[0] += 1000;  // Positions there have 1e-13 m rounding.
    EXPECT_LT((Answer(moved).tau - tau).norm(), 100 * kSame * tau.norm());
  }
}

TEST_F(InvarianceTest, MirroredInputGivesMirroredTorques) {
  const int n = tree().num_joints();
  State mirrored = state_;
  mirrored.q[1] *= -1;
  mirrored.q[3] *= -1;
  mirrored.q[5] *= -1;
  for (const int i : {0, 2, 4}) mirrored.v[i] *= -1;
  std::vector<int> twin(n);
  Eigen::VectorXd sign(n);
  for (int j = 0; j < n; ++j) {
    const Joint& joint = tree().joints()[j];
    std::string name = joint.name;
    if (name[1] == '_') name[0] = name[0] == 'l' ? 'r' : 'l';
    twin[j] = *tree().FindJoint(name);
    // A reflection reverses the axes of roll and yaw, but not of pitch.
    sign[j] = std::abs(joint.axis_F.y()) > 0.5 ? 1 : -1;
    mirrored.q[7 + twin[j]] = sign[j] * state_.q[7 + j];
    mirrored.v[6 + twin[j]] = sign[j] * state_.v[6 + j];
  }
  for (const bool with_boxes : {true, false}) {
    with_boxes_ = with_boxes;
    const Eigen::VectorXd tau = Answer(state_).tau;
    const Eigen::VectorXd answer = Answer(mirrored).tau;
    EXPECT_EQ(let_go_, with_boxes ? 0 : 1);
    for (int j = 0; j < n; ++j) {
      EXPECT_NEAR(answer[twin[j]], sign[j] * tau[j], kSame * tau.norm())
          << tree().joints()[j].name;
    }
  }
}

}  // namespace
}  // namespace poise
