// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/one_foot.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "poise/dynamics/tick.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Tolerance of a lean, rad: the search of the posture lets the base lean less
// than this to center the mass.
constexpr double kLean = 1e-3;

int HipRoll(const Robot& robot, int foot) {
  return robot.model.tree.FindJoint(foot == 0 ? "l_hip_roll" : "r_hip_roll")
      .value();
}

// Returns the potential energy of a robot at q whose foot is at X_WC, J.
double PotentialEnergy(const Robot& robot, int foot, const VectorXd& q,
                       const Pose& X_WC) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, q, VectorXd::Zero(tree.nv()), &tick);
  const Foot& sole = robot.feet[foot];
  const Pose X_VC = tick.X_WB[sole.body] * sole.X_BC;
  const Vector3d p_WG = X_WC * (X_VC.Inverse() * tick.p_WG);
  return -tree.total_mass() * tree.gravity_W().dot(p_WG);
}

// Principle of virtual work: at rest on a foot that does not move, the torque
// of a joint is the derivative of the potential energy.
TEST(TorquesOnOneFoot, AreTheDerivativeOfThePotentialEnergy) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  for (const int foot : {0, 1}) {
    const VectorXd q = FindOneFootPosture(robot, foot, {0, 0}).posture.q;
    const VectorXd tau = TorquesOnOneFoot(robot, foot, q);
    for (int j = 0; j < tree.num_joints(); ++j) {
      constexpr double kStep = 1e-5;  // rad.
      double difference = 0;
      for (const int sign : {1, -1}) {
        VectorXd moved = q;
        moved[tree.q_start() + j] += sign * kStep;
        difference += sign * PotentialEnergy(robot, foot, moved, Pose());
      }
      // The third derivative of the energy is below weight times height, 600 J,
      // and rounding is 600 J * 2e-16 / kStep: together below 1e-6 N m.
      EXPECT_NEAR(tau[j], difference / (2 * kStep), 1e-6)
          << tree.joints()[j].name;
    }
  }
}

TEST(FindOneFootPosture, LiftsTheOtherSole) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  const auto height = [&](int foot) {
    const Foot& sole = robot.feet[foot];
    return (tick.X_WB[sole.body] * sole.X_BC.p).z();
  };
  for (const int foot : {0, 1}) {
    ComputeTick(tree, robot.q_nominal, VectorXd::Zero(tree.nv()), &tick);
    const double com = tick.p_WG.z() - height(foot);
    const VectorXd q = FindOneFootPosture(robot, foot, {0, 0}).posture.q;
    ComputeTick(tree, q, VectorXd::Zero(tree.nv()), &tick);
    // The error of the soles is at most 1e-6 m.
    EXPECT_NEAR(height(1 - foot) - height(foot), 0.03 * com, 1e-6);
  }
}

TEST(FindOneFootPosture, DoesNotLeanARobotWithStrongHips) {
  const Robot robot = LoadHumanoid();
  for (const int foot : {0, 1}) {
    const OneFootPosture found = FindOneFootPosture(robot, foot, {0, 0});
    EXPECT_EQ(found.posture.lack, "");
    EXPECT_EQ(found.lean, 0);
    EXPECT_LT(found.lean_W.norm(), kLean);
    EXPECT_LT(found.load, 0.8);
  }
}

// A lean to the side of the foot moves the trunk over the hip.
TEST(FindOneFootPosture, LeansARobotWithWeakHips) {
  Robot robot = LoadHumanoid();
  for (const int foot : {0, 1}) {
    const int hip = HipRoll(robot, foot);
    const VectorXd upright = FindOneFootPosture(robot, foot, {0, 0}).posture.q;
    const double needed = std::abs(TorquesOnOneFoot(robot, foot, upright)[hip]);
    robot.model.limits[hip].effort = needed / 0.95;
    const OneFootPosture found = FindOneFootPosture(robot, foot, {0, 0});
    EXPECT_EQ(found.posture.lack, "");
    const double side = foot == 0 ? 1 : -1;
    EXPECT_GT(side * found.lean, 0);
    // To the left is a rotation about -x.
    EXPECT_NEAR(found.lean_W.x(), -found.lean, kLean);
    EXPECT_LE(found.load, 0.8);
    const double torque =
        std::abs(TorquesOnOneFoot(robot, foot, found.posture.q)[hip]);
    EXPECT_LT(torque, 0.9 * needed);
    EXPECT_GE(found.load, torque / robot.model.limits[hip].effort);
  }
}

TEST(FindOneFootPosture, DoesNotLeanARobotWhoseHipsAreFarTooWeak) {
  Robot robot = LoadHumanoid();
  robot.model.limits[HipRoll(robot, 0)].effort = 10;
  const OneFootPosture found = FindOneFootPosture(robot, 0, {0, 0});
  EXPECT_EQ(found.lean, 0);
  EXPECT_GT(found.load, 1.5);
}

// The leg has to lean by about 0.1 m / 0.8 m, so that the foot is below the
// center of mass. A hip that turns less makes the base lean.
TEST(FindOneFootPosture, LeansARobotWhoseHipsTurnTooLittle) {
  Robot robot = LoadHumanoid();
  for (const int foot : {0, 1}) {
    JointLimits& hip = robot.model.limits[HipRoll(robot, foot)];
    hip.lower = -0.06;
    hip.upper = 0.06;
  }
  for (const int foot : {0, 1}) {
    const OneFootPosture found = FindOneFootPosture(robot, foot, {0, 0});
    EXPECT_EQ(found.posture.lack, "");
    const double side = foot == 0 ? 1 : -1;
    EXPECT_LT(side * found.lean_W.x(), -0.01);
  }
}

TEST(ShiftedCenterOfMass, EndsInsideOfTheSolesMiddle) {
  Robot robot = LoadHumanoid();
  const std::vector<Pose> X_WC = {
      {Eigen::Matrix3d::Identity(), {0.1, 0.2, 0}},
      {Eigen::Matrix3d::Identity(), {0.1, -0.2, 0}}};
  const Vector3d p_WG(0.13, 0.01, 0.8);
  const double inside = robot.feet[0].half_size.y() / 4;
  EXPECT_TRUE(ShiftedCenterOfMass(robot, 0, X_WC, p_WG)
                  .isApprox(p_WG + Vector3d(0, 0.2 - inside, 0)));
  EXPECT_TRUE(ShiftedCenterOfMass(robot, 1, X_WC, p_WG)
                  .isApprox(p_WG - Vector3d(0, 0.2 - inside, 0)));
  // Half of the torque of a weak ankle holds the robot nearer to the middle.
  const Tree& tree = robot.model.tree;
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  const double reach = 0.3 * inside;
  const int ankle = tree.FindJoint("l_ankle_roll").value();
  robot.model.limits[ankle].effort = 2 * reach * weight;
  const Vector3d place = ShiftedCenterOfMass(robot, 0, X_WC, p_WG);
  // The ankle is 1 cm inside of the sole's middle, to the 6 digits of the robot
  // file and its nominal posture.
  EXPECT_TRUE(place.isApprox(p_WG + Vector3d(0, 0.19 - reach, 0), 1e-6))
      << place.transpose();
}

TEST(IsInNoLeg, LeavesOutTheJointsFromTheBaseToTheFeet) {
  const Robot robot = LoadHumanoid();
  const std::vector<bool> is_in_no_leg = IsInNoLeg(robot);
  for (int j = 0; j < robot.model.tree.num_joints(); ++j) {
    const std::string& name = robot.model.tree.joints()[j].name;
    const bool is_leg = name.find("hip") != std::string::npos ||
                        name.find("knee") != std::string::npos ||
                        name.find("ankle") != std::string::npos;
    EXPECT_EQ(is_in_no_leg[j], !is_leg) << name;
  }
}

}  // namespace
}  // namespace poise
