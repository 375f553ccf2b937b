// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/controller.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "dynamics/integrate.h"
#include "robot/profile.h"

namespace poise {
namespace {

Robot Humanoid() {
  return LoadRobot("robot/models/humanoid.urdf",
                   LoadProfile("robot/profiles/humanoid.yaml"));
}

// A robot whose feet are bolted to the floor: for v̇ and the floor's wrenches,
//     [ M  -J' ] [ v̇      ]   [ S' tau - N + f ]
//     [ J   0  ] [ lambda ] = [ -J̇ v           ].
// It knows nothing of how the controller found its torques.
class BoltedDown {
 public:
  explicit BoltedDown(const Controller& controller)
      : controller_(controller), tree_(controller.robot().model.tree) {}

  Eigen::VectorXd Solve(const Eigen::VectorXd& tau,
                        const Eigen::VectorXd& f) const {
    const Tick& tick = controller_.tick();
    const int nv = tree_.nv();
    const int feet = static_cast<int>(controller_.contacts().size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(nv + 6 * feet, nv + 6 * feet);
    Eigen::VectorXd k(nv + 6 * feet);
    K.topLeftCorner(nv, nv) = tick.M;
    k.head(nv) = f - tick.N;
    k.segment(tree_.v_start(), tree_.num_joints()) += tau;
    for (int i = 0; i < feet; ++i) {
      const ContactTick& contact = controller_.contacts()[i];
      K.block(0, nv + 6 * i, nv, 6) = -contact.J_WC_C.transpose();
      K.block(nv + 6 * i, 0, 6, nv) = contact.J_WC_C;
      k.segment<6>(nv + 6 * i) = -contact.Jdot_v_C;
    }
    return K.fullPivLu().solve(k);
  }

 private:
  const Controller& controller_;
  const Tree& tree_;
};

class ControllerTest : public testing::Test {
 protected:
  ControllerTest() {
    state_ = {0, robot_.q_nominal, Eigen::VectorXd::Zero(tree().nv())};
    controller_.Start(state_);
    command_.tau.setZero(tree().num_joints());
  }

  const Tree& tree() const { return robot_.model.tree; }

  void Update() {
    state_.time += 1e-3;
    controller_.Update(state_, &command_);
  }

  void ExpectInsideLimits() const {
    for (int j = 0; j < tree().num_joints(); ++j) {
      EXPECT_LE(std::abs(command_.tau[j]), robot_.model.limits[j].effort)
          << tree().joints()[j].name;
    }
  }

  Robot robot_ = Humanoid();
  Controller controller_{robot_};
  State state_;
  Command command_;
};

TEST_F(ControllerTest, ItsTorquesBringWhatItsSolutionSays) {
  state_.v.tail(tree().num_joints()).setConstant(0.02);
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  const int n = tree().num_joints();

  const Eigen::VectorXd& y = controller_.report().y;
  const Tick& tick = controller_.tick();
  Eigen::VectorXd residual = tick.M * y.head(tree().nv()) + tick.N;
  residual.tail(n) -= command_.tau;
  for (int i = 0; i < 2; ++i) {
    residual -= controller_.contacts()[i].J_WC_C.transpose() *
                controller_.report().foot_wrench(tree().nv(), i);
  }
  // Newtons, of 380 that the robot weighs.
  EXPECT_LT(residual.norm(), 1e-9);
}

TEST_F(ControllerTest, ComesToRestAfterAPush) {
  const int kPushTicks = 50;
  const Eigen::Vector3d kPush(0, 20, 0);  // N.
  const BoltedDown plant(controller_);
  double largest_error = 0;
  for (int i = 0; i < 800; ++i) {
    Update();
    ASSERT_NE(command_.status, TickStatus::kFailSafe);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(tree().nv());
    if (i < kPushTicks) f.segment<3>(3) = kPush;
    const Eigen::VectorXd vdot = plant.Solve(command_.tau, f).head(tree().nv());
    state_.v += 1e-3 * vdot;
    Integrate(tree(), state_.q, state_.v, 1e-3, state_.q);
    largest_error = std::max(
        largest_error,
        (controller_.tick().p_WG - controller_.reference().p_WG).norm());
  }
  // 1 N s on 38.6 kg is 26 mm/s: some millimeters away, and back again.
  EXPECT_GT(largest_error, 1e-3);
  EXPECT_LT(largest_error, 1e-2);
  EXPECT_LT((controller_.tick().p_WG - controller_.reference().p_WG).norm(),
            2e-3);
}

TEST_F(ControllerTest, FailsSafeOnANumberThatIsNone) {
  Update();
  ASSERT_EQ(command_.status, TickStatus::kOk);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (double* entry : {&state_.q[10], &state_.v[20], &state_.v[0]}) {
      const double good = *entry;
      *entry = bad;
      Update();
      EXPECT_EQ(command_.status, TickStatus::kFailSafe);
      EXPECT_TRUE(command_.tau.allFinite());
      ExpectInsideLimits();
      *entry = good;
    }
  }
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

TEST_F(ControllerTest, FailSafeHoldsTheRobotAgainstGravity) {
  Update();
  state_.q[10] = std::numeric_limits<double>::quiet_NaN();
  Update();
  const Eigen::VectorXd rest =
      BoltedDown(controller_)
          .Solve(command_.tau, Eigen::VectorXd::Zero(tree().nv()));
  // m/s2 and rad/s2: what is left is rounding, by the light fingers' inertia.
  EXPECT_LT(rest.head(tree().nv()).norm(), 1e-5);
}

TEST_F(ControllerTest, FailsSafeWhileTheClockOfTheStateStandsStill) {
  Update();
  for (int i = 1; i <= 20; ++i) {
    controller_.Update(state_, &command_);
    EXPECT_EQ(command_.status == TickStatus::kFailSafe, i > 10) << i << " ms";
  }
  Update();
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

TEST_F(ControllerTest, SwitchesATaskByName) {
  EXPECT_FALSE(controller_.stack().Enable("posturing", false));
  ASSERT_TRUE(controller_.stack().Enable("posture", false));
  Update();
  const int posture = *controller_.stack().Find("posture");
  EXPECT_FALSE(controller_.report().tasks[posture].enabled);
  EXPECT_EQ(command_.status, TickStatus::kOk);
}

}  // namespace
}  // namespace poise
