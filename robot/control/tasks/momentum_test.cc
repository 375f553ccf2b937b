// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares the rows on momentum and center of mass with the motion of the robot
// a moment later.
#include "poise/robot/control/tasks/momentum.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/math/so3.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/angular_momentum.h"
#include "poise/robot/control/tasks/com.h"
#include "poise/robot/control/tasks/linear_momentum.h"
#include "poise/robot/control/tasks/newton_euler.h"
#include "poise/robot/control/tasks/task_fixture.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

TEST_F(TaskTest, NewtonEulerHasTheBaseRowsOfTheDynamics) {
  const Eigen::VectorXd y = RandomY();
  const Tick& tick = controller_.tick();
  Eigen::VectorXd wanted = tick.M * y.head(nv_) + tick.N;
  for (int i = 0; i < 2; ++i) {
    wanted -= controller_.contacts()[i].J_WC_C.transpose() *
              y.segment<6>(nv_ + 6 * i);
  }
  const Eigen::VectorXd residual = Residual(NewtonEulerTask(tree_), y);
  const double weight = tree_.total_mass() * 9.81;
  EXPECT_LT((residual * weight / 4 - wanted.head<6>()).norm(), 1e-9);
}

// Along v̇, momentum, center of mass and feet change as the rows predict;
// compares with differences of states.
TEST_F(TaskTest, RatesOfMomentumAndFeetAreThoseOfTheMotion) {
  const double h = 1e-6;
  const Eigen::VectorXd y = RandomY();
  const Tick before = After(-h, y), after = After(h, y);
  const double m = tree_.total_mass();
  const Vector6d rate = (after.L_G - before.L_G) / (2 * h);
  const Reference& reference = controller_.reference();
  const Eigen::Vector3d e = reference.p_WG - controller_.tick().p_WG;
  const Eigen::Vector3d v_G = controller_.tick().v_WG;
  const Vector6d L = controller_.tick().L_G;
  // Central differences over 1e-6 s have an error of 1e-5 of the rates.
  const double tolerance = 1e-4;

  const Eigen::VectorXd momentum =
      Residual(MomentumTask(tree_, robot_.feet), y);
  const Eigen::Vector3d linear = rate.tail<3>() / m - 30 * e + 10 * v_G;
  EXPECT_LT((momentum.tail<3>() - linear).norm(), tolerance);
  // The base is at its reference, so there is no rotation to correct.
  EXPECT_LT(
      (momentum.head<3>() - (rate.head<3>() + 10 * L.head<3>()) / m).norm(),
      tolerance);
  EXPECT_LT((Residual(ComTask(tree_), y) - linear).norm(), tolerance);
  EXPECT_LT(
      (Residual(LinearMomentumTask(tree_), y) - (rate.tail<3>() / m + 10 * v_G))
          .norm(),
      tolerance);
  EXPECT_LT(
      (Residual(AngularMomentumTask(tree_), y) - momentum.head<3>()).norm(),
      1e-12);
}

// The residual of a momentum row in the report is in N or N m, whatever the
// scale of the row. The reference moves, with feed-forward, and the base is
// rotated.
TEST_F(TaskTest, MomentumResidualsAreForces) {
  const Eigen::VectorXd y = RandomY();
  const auto loss = [&](const Task& task, const Eigen::VectorXd& at) {
    Eigen::VectorXd residual = Residual(task, at);
    for (int i = 0; i < residual.size(); ++i) {
      residual[i] *= task.equality_scale(i);
    }
    return residual;
  };
  Eigen::VectorXd more = y;
  for (int i = 0; i < nv_; ++i) more[i] += Uniform(-1, 1);
  const Eigen::VectorXd F =
      controller_.tick().H_G * (more.head(nv_) - y.head(nv_));
  const AngularMomentumTask angular(tree_);
  const LinearMomentumTask linear(tree_);
  const MomentumTask both(tree_, robot_.feet);
  EXPECT_LT((loss(angular, more) - loss(angular, y) - F.head(3)).norm(), 1e-9);
  EXPECT_LT((loss(linear, more) - loss(linear, y) - F.tail(3)).norm(), 1e-9);
  EXPECT_LT((loss(both, more) - loss(both, y) - F).norm(), 1e-9);
}

TEST_F(TaskTest, MomentumFollowsItsReference) {
  MomentumTask momentum(tree_, robot_.feet);
  ComTask com(tree_);
  LinearMomentumTask linear(tree_);
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd before = Residual(momentum, y);
  const Eigen::VectorXd com_before = Residual(com, y);
  const Eigen::VectorXd linear_before = Residual(linear, y);

  Reference& reference = controller_.reference();
  const Eigen::Vector3d p(0.01, -0.02, 0.03), v(0.1, 0.2, -0.3), a(1, 2, 3);
  const Eigen::Vector3d turn(0.02, -0.03, 0.05);  // rad, in world axes.
  reference.p_WG += p;
  reference.v_WG = v;
  reference.a_WG = a;
  const Eigen::Matrix3d R_WB = controller_.tick().X_WB[0].R;
  reference.R_WB = ExpSo3(turn) * R_WB;
  Eigen::VectorXd asked = before - Residual(momentum, y);
  EXPECT_LT((asked.head<3>() - 200 / tree_.total_mass() * turn).norm(), 1e-9);
  EXPECT_LT((asked.tail<3>() - 30 * p).norm(), 1e-9);
  EXPECT_LT((com_before - Residual(com, y) - (30 * p + 10 * v + a)).norm(),
            1e-9);
  EXPECT_LT((linear_before - Residual(linear, y) - (10 * v + a)).norm(), 1e-9);

  for (const Parameter& each : momentum.parameters()) {
    if (each.name == "feedforward") *each.value = 1;
  }
  asked = before - Residual(momentum, y);
  EXPECT_LT((asked.tail<3>() - (30 * p + 10 * v + a)).norm(), 1e-9);
}

// With a quarter of the pelvis's moments of inertia, the trunk is the torso.
// Where the reference turns the chest, it turns the torso.
TEST_F(TaskTest, MomentumKeepsTheTrunkUprightOnALightPelvis) {
  std::ifstream file("robot/models/humanoid.urdf");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const auto divide = [&](const std::string& moment) {
    const size_t at = text.find(moment, text.find("<link name=\"pelvis\""));
    text.replace(at + 5, 4, "0.00");  // 0.0165799 becomes 0.0065799.
  };
  for (const char* moment : {"ixx=\"0.0", "iyy=\"0.0", "izz=\"0.0"}) {
    divide(moment);
  }
  const RobotModel model = ParseUrdf(text, "humanoid");
  const MomentumTask momentum(model.tree, robot_.feet);
  const MomentumTask of_base(tree_, robot_.feet);
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd before = Residual(momentum, y);
  const Eigen::VectorXd base_before = Residual(of_base, y);
  const double turn = 0.03;  // rad.
  controller_.reference().posture[*tree_.FindJoint("chest_yaw")] += turn;
  const Eigen::Vector3d wanted = (before - Residual(momentum, y)).head<3>();
  // The torso is upright in the nominal posture: the axis is z, and the pitch
  // of the pelvis is 0.
  const Eigen::Vector3d axis = controller_.tick().X_WB[0].R.col(2);
  EXPECT_LT((wanted - 200 / tree_.total_mass() * turn * axis).norm(), 1e-9);
  EXPECT_EQ(Residual(of_base, y), base_before);
}

// The height keeps its own gains, because it is not unstable.
TEST_F(TaskTest, MomentumIsStifferInLargePushesExceptInHeight) {
  MomentumTask momentum(tree_, robot_.feet);
  for (const Parameter& each : momentum.parameters()) {
    if (each.name == "angular_weight") *each.value = 2;
  }
  const Eigen::Vector3d p(0.01, -0.02, 0.03);
  const auto write = [&](double capture) {
    hierarchy_ = Hierarchy(nv_ + 12, {{6, 0}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 6);
    InequalityBlock none = hierarchy_.AddInequalities(0, 0);
    TaskInput now = input();
    now.capture = capture;
    now.correction_W = Eigen::Vector3d(0.1, 0.2, 0.3);
    momentum.Write(now, &rows, &none);
    return Eigen::Vector3d(rows.b.tail<3>());
  };
  for (const double capture : {0.0, 0.5, 1.0}) {
    const Eigen::Vector3d before = write(capture);
    EXPECT_NEAR(hierarchy_.weight(0)[0], 2 * std::pow(0.3 / 2, capture), 1e-12);
    controller_.reference().p_WG += p;
    const Eigen::Vector3d asked = before - write(capture);
    controller_.reference().p_WG -= p;
    const double kp = 30 + 30 * capture;
    EXPECT_LT((asked - Eigen::Vector3d(kp, kp, 30).cwiseProduct(p)).norm(),
              1e-9);
  }
  // A correction adds to the acceleration.
  const Eigen::Vector3d corrected = write(0);
  const Eigen::VectorXd plain = Write(momentum).b(0);
  EXPECT_LT(
      (plain.tail<3>() - corrected - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(),
      1e-12);
}

// With a pendulum, the plane has the acceleration of a pendulum with this CoP,
// and the height follows its reference up to max_rise.
TEST_F(TaskTest, MomentumFollowsAPendulum) {
  const MomentumTask momentum(tree_, robot_.feet);
  Reference& reference = controller_.reference();
  const Eigen::Vector3d p_WG = controller_.tick().p_WG;
  reference.pendulum.is_on = true;
  reference.pendulum.omega = 3;
  reference.pendulum.p_WZ = p_WG.head<2>() - Eigen::Vector2d(0.1, -0.2);
  reference.pendulum.angular_weight = 7;
  reference.pendulum.height_weight = 5;
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd with = Residual(momentum, y);
  EXPECT_EQ(hierarchy_.weight(0)[0], 7);
  EXPECT_EQ(hierarchy_.weight(0)[5], 5);
  // The rate of the linear momentum, from finite differences of its motion.
  const double t = 1e-6;
  const Eigen::Vector3d a =
      (After(t, y).L_G.tail<3>() - After(-t, y).L_G.tail<3>()) /
      (2 * t * tree_.total_mass());
  // Central differences lose half of the digits: 1e-10 / 1e-6 times a speed of
  // 1 m/s.
  EXPECT_NEAR(with[3], a.x() - 9 * 0.1, 1e-3);
  EXPECT_NEAR(with[4], a.y() + 9 * 0.2, 1e-3);
  reference.p_WG.z() = p_WG.z() + 1;  // Asks for 30 m/s2.
  const double free = Residual(momentum, y)[5];
  reference.pendulum.max_rise = 2;
  const double bounded = Residual(momentum, y)[5];
  EXPECT_NEAR(bounded, a.z() - 2, 1e-3);
  EXPECT_GT(bounded - free, 20);
}
}  // namespace
}  // namespace poise
