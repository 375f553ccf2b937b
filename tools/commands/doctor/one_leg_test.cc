// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/one_leg.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "poise/robot/control/posture/one_foot.h"
#include "poise/robot/control/stand.h"

namespace poise {
namespace {

using Eigen::VectorXd;

Robot Humanoid() {
  return LoadStandingRobot("robot/models/humanoid.urdf",
                           LoadProfile("robot/profiles/humanoid.yaml"));
}

std::string Findings(const Robot& robot) {
  std::string text;
  for (const Finding& finding : FindOneLegDefects(robot)) {
    EXPECT_EQ(finding.severity, Severity::kWarn);
    text += finding.where + " " + finding.what + "\n";
  }
  return text;
}

TEST(FindOneLegDefects, AcceptsTheHumanoid) {
  EXPECT_EQ(Findings(Humanoid()), "");
}

TEST(FindOneLegDefects, NamesNarrowSole) {
  Robot robot = Humanoid();
  robot.feet[1].half_size.y() = 0.01;
  const std::string found = Findings(robot);
  EXPECT_EQ(found.find("right_foot cannot stand on one leg: its sole is 0.02 m "
                       "wide, must be 0.03"),
            0u)
      << found;
}

// With rigid joints, the center of mass cannot move over a sole.
TEST(FindOneLegDefects, NamesJointRange) {
  Robot robot = Humanoid();
  for (int j = 0; j < robot.model.tree.num_joints(); ++j) {
    JointLimits& limits = robot.model.limits[j];
    limits.lower = limits.upper = robot.q_nominal[7 + j];
  }
  const std::string found = Findings(robot);
  EXPECT_NE(found.find("left_foot cannot stand on one leg: "),
            std::string::npos)
      << found;
  EXPECT_NE(found.find("at its limit"), std::string::npos) << found;
}

// On one foot, the hip carries the weight of the body at the lever arm of half
// the hip's width: about 60 kg x 9.81 m/s2 x 0.1 m. On two feet it does not.
TEST(FindOneLegDefects, NamesWeakMotor) {
  Robot robot = Humanoid();
  robot.model.limits[robot.model.tree.FindJoint("r_hip_roll").value()].effort =
      10;
  const std::string found = Findings(robot);
  EXPECT_EQ(found.find("right_foot cannot stand on one leg: joint 'r_hip_roll' "
                       "needs "),
            0u)
      << found;
  EXPECT_NE(found.find("(limit 10 N m)"), std::string::npos) << found;
}

// The shift puts the center of mass over the ankle, so the joint needs no
// torque.
TEST(FindOneLegDefects, NamesAnAnkleWithoutMotor) {
  Robot robot = Humanoid();
  robot.model.limits[robot.model.tree.FindJoint("l_ankle_roll").value()]
      .effort = 0;
  const std::string found = Findings(robot);
  EXPECT_EQ(found.find("left_foot cannot stand on one leg: joint "
                       "'l_ankle_roll' has no motor"),
            0u)
      << found;
  EXPECT_EQ(found.find("right_foot"), std::string::npos) << found;
}

// A lean of the base hardly changes the torque of the knee.
TEST(FindOneLegDefects, NamesAMotorThatIsNearlyFullyLoaded) {
  Robot robot = Humanoid();
  const int knee = robot.model.tree.FindJoint("l_knee").value();
  const VectorXd q = FindOneFootPosture(robot, 0, {0, 0}).posture.q;
  robot.model.limits[knee].effort =
      std::abs(TorquesOnOneFoot(robot, 0, q)[knee]) / 0.96;
  const std::string found = Findings(robot);
  EXPECT_EQ(found.find("left_foot cannot stand on one leg: joint 'l_knee' "
                       "needs "),
            0u)
      << found;
  EXPECT_NE(found.find("too little is left to balance with"), std::string::npos)
      << found;
}

// Without any motor, the hip carries the largest torque: all of the body except
// a leg is above it, at a lever arm of half the distance of the hips.
TEST(FindOneLegDefects, NamesTheMostLoadedOfSeveralJointsWithoutMotors) {
  Robot robot = Humanoid();
  for (JointLimits& limits : robot.model.limits) limits.effort = 0;
  const std::string found = Findings(robot);
  for (const std::string side : {"l", "r"}) {
    EXPECT_NE(found.find("joint '" + side + "_hip_roll' needs "),
              std::string::npos)
        << found;
  }
}

// Rounding errors are the only torque about a vertical axis through the trunk's
// center of mass.
TEST(FindOneLegDefects, AcceptsAJointWithoutAMotorThatCarriesNothing) {
  Robot robot = Humanoid();
  robot.model.limits[robot.model.tree.FindJoint("neck_yaw").value()].effort = 0;
  EXPECT_EQ(Findings(robot), "");
}

}  // namespace
}  // namespace poise
