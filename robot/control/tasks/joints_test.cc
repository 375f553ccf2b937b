// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests the rows on joints: limits, torques, couplings and posture.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/hanging_joints.h"
#include "poise/robot/control/tasks/joint_limits.h"
#include "poise/robot/control/tasks/light_joints.h"
#include "poise/robot/control/tasks/mimic.h"
#include "poise/robot/control/tasks/posture.h"
#include "poise/robot/control/tasks/task_fixture.h"
#include "poise/robot/control/tasks/torque_limits.h"
#include "poise/robot/control/tasks/torque_minimization.h"
#include "poise/robot/control/torque.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

TEST_F(TaskTest, JointLimitsBringAJointToRestAtItsStop) {
  const JointLimitsTask task(robot_.model);
  const int j = *tree_.FindJoint("l_elbow");
  for (const auto& [side, push] : {std::pair(1., 0.), std::pair(-1., 0.),
                                   std::pair(1., 30.), std::pair(-1., 30.)}) {
    unmodelled_vdot_[6 + j] = push;  // Unmodelled acceleration, rad/s2.
    const JointLimits& limits = robot_.model.limits[j];
    constexpr double kMargin = 0.008;  // rad.
    const double stop =
        side > 0 ? limits.upper - kMargin : limits.lower + kMargin;
    state_.q[7 + j] = stop - side * 0.2;
    state_.v[6 + j] = side * 7.9;  // Slow enough: below w 0.2 rad.
    double nearest = 1;
    for (int i = 0; i < 1000; ++i) {
      const Hierarchy& rows = Write(task);
      const double bound = (side > 0 ? rows.upper(0)[j] : rows.lower(0)[j]) /
                           rows.C(0)(j, 6 + j);
      state_.v[6 + j] += 1e-3 * (bound + push);
      state_.q[7 + j] += 1e-3 * state_.v[6 + j];
      nearest = std::min(nearest, side * (stop - state_.q[7 + j]));
    }
    EXPECT_GE(nearest, -1e-9);
    EXPECT_LT(nearest, 1e-3);
    EXPECT_LT(std::abs(state_.v[6 + j]), 1e-3);
  }
}

// An ankle of a foot in contact comes to rest at its stop as well, and brakes
// by at most what stops it at a constant rate.
TEST_F(TaskTest, JointLimitsBrakeAnAnkleOnTheGroundByWhatIsNecessary) {
  RobotModel model = robot_.model;
  const int j = *tree_.FindJoint("l_ankle_roll");
  constexpr double kMargin = 0.008;  // rad.
  constexpr double kOmega = 40;      // 1/s.
  constexpr double kDistance = 0.1;  // rad.
  const JointLimits limits = model.limits[j];
  model.limits[j].velocity = 100;  // So that its bound is not active.
  const JointLimitsTask task(model, robot_.feet);
  const JointLimitsTask without_feet(model);
  for (const double side : {1., -1.}) {
    const double stop =
        side > 0 ? limits.upper - kMargin : limits.lower + kMargin;
    const auto bound = [&](const JointLimitsTask& of) {
      const Hierarchy& rows = Write(of);
      return side * (side > 0 ? rows.upper(0)[j] : rows.lower(0)[j]) /
             rows.C(0)(j, 6 + j);
    };
    const auto start = [&](double speed) {
      state_.q[7 + j] = stop - side * kDistance;
      state_.v[6 + j] = side * speed;
    };
    // Moves the joint on its bound, and returns its least distance to the stop.
    double hardest = 0;  // Brake, rad/s2.
    const auto nearest = [&](const JointLimitsTask& of, double speed) {
      start(speed);
      hardest = 0;
      double least = kDistance;
      for (int i = 0; i < 5000; ++i) {
        const double vdot = bound(of);
        hardest = std::max(hardest, -vdot);
        state_.v[6 + j] += 1e-4 * side * vdot;
        state_.q[7 + j] += 1e-4 * state_.v[6 + j];
        least = std::min(least, side * (stop - state_.q[7 + j]));
      }
      // 0.5 s are 20 time constants, and 0.3 rad * 21 * exp(-20) is 1.3e-8 rad.
      EXPECT_LT(std::abs(side * (stop - state_.q[7 + j])), 1e-6) << speed;
      return least;
    };
    for (const double share : {0.3, 0.6, 0.8, 1., 2., 4., 10.}) {
      const double speed = share * kOmega * kDistance;
      const double constant = speed * speed / (2 * kDistance);
      start(speed);
      const double law = bound(without_feet);
      const double rounding = 1e-12 * kOmega * speed;
      EXPECT_GE(bound(task), std::min(law, -constant) - rounding) << share;
      EXPECT_LE(bound(task), std::max(law, -constant) + rounding) << share;
      // The joint may use a quarter of its margin of 8 mrad.
      const double before = nearest(without_feet, speed);
      EXPECT_GE(nearest(task, speed), std::min(before, -kMargin / 4)) << share;
      if (share < 0.6 || share > 3) continue;
      EXPECT_LT(hardest, 1.2 * constant) << share;
    }
  }
  // The other foot's ankle has the same law, and a knee the other one.
  for (const auto& [name, is_ankle] :
       {std::pair("r_ankle_pitch", true), std::pair("l_knee", false)}) {
    const int k = *tree_.FindJoint(name);
    state_.q[7 + k] = robot_.model.limits[k].upper - kMargin - 0.1;
    state_.v[6 + k] = kOmega * 0.1;
    model.limits[k].velocity = 100;
    const double with_feet =
        Write(JointLimitsTask(model, robot_.feet)).upper(0)[k];
    const double without = Write(JointLimitsTask(model)).upper(0)[k];
    EXPECT_EQ(with_feet > without, is_ankle) << name;
  }
  // In the air, all joints have the other one.
  std::vector<ContactTick> contacts = controller_.contacts();
  for (ContactTick& contact : contacts) contact.in_contact = false;
  const JointLimitsTask of_ankles(model, robot_.feet);
  const Eigen::VectorXd damped = Write(JointLimitsTask(model)).upper(0);
  hierarchy_.Clear(1);
  EqualityBlock none = hierarchy_.AddEqualities(0, 0);
  InequalityBlock rows = hierarchy_.AddInequalities(0, n_);
  of_ankles.Write({state_, controller_.tick(), contacts,
                   controller_.reference(), unmodelled_vdot_},
                  &none, &rows);
  EXPECT_EQ(hierarchy_.upper(0), damped);
}

TEST_F(TaskTest, JointLimitsBrakeAFastJointGently) {
  const JointLimitsTask task(robot_.model);
  const int j = *tree_.FindJoint("l_elbow");
  const double fastest = robot_.model.limits[j].velocity;
  constexpr double kOmega = 40;  // 1/s.
  const JointLimits& limits = robot_.model.limits[j];
  for (const double side : {1., -1.}) {
    // No position limit is near.
    state_.q[7 + j] = side > 0 ? limits.lower + 0.1 : limits.upper - 0.1;
    for (const double times : {1.1, 1.25, 2., 5.}) {
      state_.v[6 + j] = side * times * fastest;
      const Hierarchy& rows = Write(task);
      const double bound = side *
                           (side > 0 ? rows.upper(0)[j] : rows.lower(0)[j]) /
                           rows.C(0)(j, 6 + j);
      const double stop =
          kOmega * kOmega * (limits.upper - limits.lower - 0.108) -
          2 * kOmega * times * fastest;
      const double brake = kOmega * fastest * std::min(times - 1, 0.25);
      EXPECT_NEAR(bound, std::min(-brake, stop), 1e-9) << times;
    }
  }
}

// A file may give 0.5 rad/s as a placeholder. A landing needs accelerations of
// about 100 rad/s2 in the legs, so the rows must allow them.
TEST_F(TaskTest, JointLimitsLetASlowJointFollowALanding) {
  RobotModel model = robot_.model;
  const int j = *tree_.FindJoint("l_elbow");
  constexpr double kSlow = 3;  // rad/s; smaller limits count as this one.
  model.limits[j].velocity = 0.5;
  const JointLimitsTask task(model);
  state_.q[7 + j] = robot_.q_nominal[7 + j];
  state_.v[6 + j] = 0;
  const Hierarchy* rows = &Write(task);
  EXPECT_GT(rows->upper(0)[j] / rows->C(0)(j, 6 + j), 100);
  EXPECT_LT(rows->lower(0)[j] / rows->C(0)(j, 6 + j), -100);
  state_.v[6 + j] = kSlow;
  rows = &Write(task);
  // At the limit, the joint may not become faster. The bound is a difference
  // of equal numbers of at most 200 rad/s2.
  EXPECT_NEAR(rows->upper(0)[j] / rows->C(0)(j, 6 + j), 0, 1e-12);
  EXPECT_LT(rows->lower(0)[j] / rows->C(0)(j, 6 + j), -100);
}

TEST_F(TaskTest, JointLimitsHoldTheSpeed) {
  const JointLimitsTask task(robot_.model);
  const int j = *tree_.FindJoint("l_elbow");
  const double fastest = robot_.model.limits[j].velocity;
  state_.q[7 + j] = robot_.q_nominal[7 + j];
  state_.v[6 + j] = fastest;
  EXPECT_LE(Write(task).upper(0)[j], 1e-12);
  state_.v[6 + j] = -fastest;
  EXPECT_GE(Write(task).lower(0)[j], -1e-12);
  // At rest the joint may accelerate equally in both directions.
  state_.v[6 + j] = 0;
  EXPECT_GT(Write(task).upper(0)[j], 0);
  EXPECT_LT(Write(task).lower(0)[j], 0);
}

// Left and right are the same, also beyond the limits, where position and speed
// limits contradict each other.
TEST_F(TaskTest, JointLimitsAreTheSameForAMirroredState) {
  const int j = *tree_.FindJoint("l_elbow");
  constexpr double kSpeed = 8;
  // The second range is narrower than its margins.
  for (const double limit : {1.0, 0.004}) {
    robot_.model.limits[j] = {-limit, limit, kSpeed, 10};
    const JointLimitsTask task(robot_.model);
    const auto bounds = [&](double side, double q, double v) {
      state_.q[7 + j] = side * q;
      state_.v[6 + j] = side * v;
      unmodelled_vdot_[6 + j] = side * 20;
      const Hierarchy& rows = Write(task);
      const double low = rows.lower(0)[j], high = rows.upper(0)[j];
      EXPECT_LE(low, high) << q << ", " << v;
      return side > 0 ? std::pair(low, high) : std::pair(-high, -low);
    };
    for (const double beyond : {-0.3, 0.0, 0.05, 0.3, 0.6}) {
      for (const double v : {-20.0, -8.0, -1.0, 0.0, 1.0, 8.0, 20.0}) {
        EXPECT_EQ(bounds(1, limit + beyond, v), bounds(-1, limit + beyond, v))
            << beyond << ", " << v;
      }
    }
  }
}

// At rest beyond a limit, a joint returns as its position limit demands,
// whatever its speed limit.
TEST_F(TaskTest, JointLimitsBringAJointBackFromBeyond) {
  const int j = *tree_.FindJoint("l_elbow");
  robot_.model.limits[j] = {-1, 1, 8, 10};
  const JointLimitsTask task(robot_.model);
  state_.v[6 + j] = 0;
  for (const double beyond : {0.05, 0.3, 0.6}) {
    state_.q[7 + j] = 1 + beyond;
    EXPECT_NEAR(Write(task).upper(0)[j], -beyond - 0.008, 1e-12);
    state_.q[7 + j] = -1 - beyond;
    EXPECT_NEAR(Write(task).lower(0)[j], beyond + 0.008, 1e-12);
  }
}

// Without a bound, a finger of 2 mg without <limit> would supply the momentum
// of a push.
TEST_F(TaskTest, JointLimitsBoundAJointWithoutLimits) {
  const int j = *tree_.FindJoint("l_elbow");
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const double velocity : {kNone, 0.0}) {
    robot_.model.limits[j] = {-kNone, kNone, velocity, kNone};
    const JointLimitsTask task(robot_.model);
    state_.v[6 + j] = 0;
    const Hierarchy& rows = Write(task);
    // At rest, the bound reaches 30 rad/s in 1/40 s.
    EXPECT_NEAR(rows.upper(0)[j] / rows.C(0)(j, 6 + j), 30 * 40, 1e-9);
    EXPECT_NEAR(rows.lower(0)[j] / rows.C(0)(j, 6 + j), -30 * 40, 1e-9);
  }
}

TEST_F(TaskTest, TorqueRowsAreThoseOfTheSolution) {
  const Eigen::VectorXd y = RandomY();
  Eigen::VectorXd tau(n_);
  ComputeTorque(controller_.tick(), controller_.contacts(), y, &tau);
  const TorqueLimitsTask limits(robot_.model);
  const Hierarchy& rows = Write(limits);
  const Eigen::VectorXd value = rows.C(0) * y;
  for (int j = 0; j < n_; ++j) {
    const double effort = robot_.model.limits[j].effort;
    // If C y is at its upper bound, the torque is at its limit.
    EXPECT_NEAR(1 - (rows.upper(0)[j] - value[j]), tau[j] / effort, 1e-9);
    EXPECT_NEAR((value[j] - rows.lower(0)[j]) - 1, tau[j] / effort, 1e-9);
  }
  const TorqueMinimizationTask minimization(robot_.model);
  const Eigen::VectorXd small = Residual(minimization, y);
  for (int j = 0; j < n_; ++j) {
    EXPECT_NEAR(small[j], tau[j] / robot_.model.limits[j].effort, 1e-9);
    EXPECT_NEAR(small[j] * minimization.equality_scale(j), tau[j], 1e-9);
  }
}

// A passive joint has torque 0 for any scale of the other joints, and no
// joint-limit row.
TEST_F(TaskTest, RowsRespectAJointWithoutMotor) {
  const int j = *tree_.FindJoint("l_elbow");
  robot_.model.limits[j].effort = 0;
  const TorqueLimitsTask torques(robot_.model);
  for (const Parameter& each : torques.parameters()) *each.value = 0.5;
  const Eigen::VectorXd y = RandomY();
  Eigen::VectorXd tau(n_);
  ComputeTorque(controller_.tick(), controller_.contacts(), y, &tau);
  const Hierarchy& rows = Write(torques);
  EXPECT_NEAR(rows.C(0).row(j).dot(y) - rows.lower(0)[j], tau[j], 1e-9);
  EXPECT_EQ(rows.lower(0)[j], rows.upper(0)[j]);

  state_.q[7 + j] = robot_.model.limits[j].upper + 0.2;
  const Hierarchy& limits = Write(JointLimitsTask(robot_.model));
  EXPECT_TRUE(limits.C(0).row(j).isZero(0));
  EXPECT_FALSE(std::isfinite(limits.lower(0)[j]) ||
               std::isfinite(limits.upper(0)[j]));
}

// A wrong profile must not raise a limit above that of the motor.
TEST_F(TaskTest, TorqueLimitsNeverExceedTheMotors) {
  const TorqueLimitsTask task(robot_.model);
  ASSERT_EQ(task.parameters().size(), 1u);
  EXPECT_EQ(task.parameters()[0].name, "scale");
  EXPECT_EQ(task.parameters()[0].upper, 1);
}

// A tip of 2 mg on a finger of 1 g on a body of 1 kg.
TEST(LightJoints, AreJointsOfNegligibleMass) {
  std::string text = "<robot name='r'>";
  const auto link = [&](const std::string& name, const std::string& mass) {
    text += "<link name='" + name + "'><inertial><mass value='" + mass +
            "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
            "</inertial></link>";
  };
  const auto joint = [&](const std::string& child, const std::string& parent) {
    text += "<joint name='" + child + "' type='continuous'><parent link='" +
            parent + "'/><child link='" + child + "'/></joint>";
  };
  link("body", "1");
  link("carries", "2e-6");
  link("finger", "1e-3");
  link("tip", "2e-6");
  link("coupled", "2e-6");
  joint("carries", "body");
  joint("finger", "carries");
  joint("tip", "finger");
  joint("coupled", "finger");
  RobotModel model = ParseUrdf(text + "</robot>", "robot");
  const int tip = *model.tree.FindJoint("tip");
  model.mimics = {{*model.tree.FindJoint("coupled"), tip, 1, 0}};
  EXPECT_EQ(FindLightJoints(model), std::vector<int>{tip});
}

TEST_F(TaskTest, LightJointsFollowThePosture) {
  std::ifstream file("robot/models/humanoid.urdf");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const size_t mass =
      text.find("value=", text.find("<link name=\"l_index_distal\""));
  text.replace(mass, std::string("value=\"0.004\"").size(), "value=\"2e-6\"");
  const LightJointsTask task(ParseUrdf(text, "humanoid"));
  const int j = *tree_.FindJoint("l_index_2");
  ASSERT_EQ(task.equality_names(),
            std::vector<std::string>{"light_joints.l_index_2"});
  controller_.reference().posture[j] += 0.1;
  const Eigen::VectorXd y = RandomY();
  EXPECT_NEAR(Residual(task, y)[0], y[6 + j] - 60 * 0.1 + 15 * state_.v[6 + j],
              1e-12);
}

// The error of a coupling decays to 0 as a damped spring does.
TEST_F(TaskTest, MimicIsASpringOnTheCouplingError) {
  const int joint = *tree_.FindJoint("l_index_2");
  const int source = *tree_.FindJoint("l_index_1");
  const int other = *tree_.FindJoint("l_middle_2");
  robot_.model.mimics = {{joint, source, -1.5, 0.3}, {other, source, 2, 0}};
  MimicTask task(robot_.model);
  EXPECT_EQ(task.equality_names()[0], "mimic.l_index_2");
  const double kp = 7, kd = 3;
  for (const Parameter& each : task.parameters()) {
    *each.value = each.name == "kp" ? kp : kd;
  }
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd residual = Residual(task, y);
  for (int i = 0; i < 2; ++i) {
    const MimicCoupling& c = robot_.model.mimics[i];
    const double off = state_.q[7 + c.joint] -
                       (c.multiplier * state_.q[7 + c.source] + c.offset);
    const double rate =
        state_.v[6 + c.joint] - c.multiplier * state_.v[6 + c.source];
    const double acceleration = y[6 + c.joint] - c.multiplier * y[6 + c.source];
    EXPECT_NEAR(residual[i], acceleration + kd * rate + kp * off, 1e-12);
  }
}

TEST_F(TaskTest, PostureIsAPdOnEachJoint) {
  const Eigen::VectorXd y = RandomY();
  controller_.reference().posture[3] += 0.1;
  const Eigen::VectorXd residual = Residual(PostureTask(robot_.model), y);
  for (int j = 0; j < n_; ++j) {
    const double e = j == 3 ? 0.1 : 0;
    EXPECT_NEAR(residual[j], y[6 + j] - 60 * e + 15 * state_.v[6 + j], 1e-12);
  }
}

// The finger l_index has no motor. The elbow has none, but the wrist beyond it
// has.
TEST_F(TaskTest, PostureLeavesOutHangingJoints) {
  const int elbow = *tree_.FindJoint("l_elbow");
  const int proximal = *tree_.FindJoint("l_index_1");
  const int distal = *tree_.FindJoint("l_index_2");
  for (const int j : {elbow, proximal, distal}) {
    robot_.model.limits[j].effort = 0;
  }
  const std::vector<bool> hangs = FindHangingJoints(robot_.model);
  for (int j = 0; j < n_; ++j) {
    EXPECT_EQ(hangs[j], j == proximal || j == distal) << tree_.joints()[j].name;
  }
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd residual = Residual(PostureTask(robot_.model), y);
  EXPECT_EQ(residual[proximal], 0);
  EXPECT_EQ(residual[distal], 0);
  EXPECT_NE(residual[elbow], 0);
}

TEST_F(TaskTest, PostureWeightsAJointByItsInertia) {
  const Eigen::VectorXd weight = Write(PostureTask(robot_.model)).weight(0);
  for (int j = 0; j < n_; ++j) {
    const double moved = controller_.tick().M(6 + j, 6 + j);
    EXPECT_NEAR(std::pow(weight[j], 2), std::clamp(moved, 0.01, 10.0), 1e-12);
  }
  EXPECT_LT(weight[*tree_.FindJoint("l_elbow")],
            weight[*tree_.FindJoint("chest_pitch")]);
}

// A prismatic joint has forces in N and positions in m.
TEST(JointTasks, DescribeAPrismaticJointInItsUnits) {
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
      "ixz='0' iyz='0'/></inertial>";
  const RobotModel model = ParseUrdf(
      "<robot name='lift'><link name='a'>" + mass + "</link><link name='b'>" +
          mass +
          "</link><joint name='mast_lift' type='prismatic'><parent link='a'/>"
          "<child link='b'/><axis xyz='0 0 1'/><limit lower='0' upper='1' "
          "effort='10' velocity='1'/></joint></robot>",
      "lift");
  const RowDescription torque = TorqueLimitsTask(model).inequalities()[0];
  EXPECT_EQ(torque.name, "torque.mast_lift");
  EXPECT_EQ(torque.unit, "N");
  EXPECT_EQ(torque.phrase, "the force of mast lift");
  EXPECT_EQ(JointLimitsTask(model).inequalities()[0].unit, "m");
  EXPECT_EQ(PostureTask(model).equalities()[0].unit, "m/s2");
  EXPECT_EQ(TorqueMinimizationTask(model).equalities()[0].unit, "N");
}

}  // namespace
}  // namespace poise
