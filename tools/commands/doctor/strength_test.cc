// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/strength.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tools/commands/doctor/biped_fixture.h"

namespace poise {
namespace {

Robot Stand(const SmallBiped& biped) {
  return MakeStandingRobot(UrdfDocument(TextOf(biped), "robot.urdf"));
}

// Returns weight times lever arm of the fixture's left arm: 1 kg, 0.15 m below
// the shoulder.
double TorqueOfArm(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv()), &tick);
  const int body = tree.FindJoint("left_arm").value() + 1;
  const Eigen::Vector3d p_AG_W =
      tick.X_WB[body].R * Eigen::Vector3d(0, 0, -0.15);
  return tree.gravity_W().norm() * std::abs(p_AG_W.x());
}

TEST(FindWeakness, ComparesLimitWithTheStaticTorque) {
  SmallBiped biped;
  biped.arm_tilt = 1.4;
  Robot robot = Stand(biped);
  const double torque = TorqueOfArm(robot);
  ASSERT_GT(torque, 1);  // N m. The arm reaches forward.
  const int arm = robot.model.tree.FindJoint("left_arm").value();
  robot.model.limits[arm].effort = 1.01 * torque;
  EXPECT_TRUE(FindWeakness(robot).empty());
  robot.model.limits[arm].effort = 0.95 * torque;
  const auto findings = FindWeakness(robot);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::kWarn);
  EXPECT_EQ(findings[0].where, "joint 'left_arm'");
  EXPECT_EQ(findings[0].what.find("needs "), 0u) << findings[0].what;
  // PrintNumber() rounds to six digits; the solver's slack is as exact.
  EXPECT_NEAR(std::stod(findings[0].what.substr(6)), torque, 1e-4 * torque);
}

// Bent knees carry the weight of the bodies above.
TEST(FindWeakness, NamesWeakLegs) {
  const Robot strong = Stand({});
  EXPECT_TRUE(FindWeakness(strong).empty());
  Robot weak = strong;
  for (const char* knee : {"left_knee", "right_knee"}) {
    weak.model.limits[weak.model.tree.FindJoint(knee).value()].effort = 0;
  }
  const auto findings = FindWeakness(weak);
  ASSERT_FALSE(findings.empty());
  std::string all;
  for (const Finding& finding : findings) {
    all += finding.where + ": " + finding.why + "\n";
  }
  EXPECT_NE(all.find("joint 'left_knee': the file gives the joint no motor"),
            std::string::npos)
      << all;
}

// The soles are 0.3 m behind the center of mass: no force there balances it.
TEST(FindWeakness, FindsPostureThatSolesCannotBalance) {
  Robot robot = Stand({});
  for (Foot& foot : robot.feet) {
    foot.X_BC.p -= foot.X_BC.R.col(0) * 0.3;
  }
  const auto findings = FindWeakness(robot);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.back().where, "robot");
  EXPECT_EQ(findings.back().what, "cannot hold its posture");
}

}  // namespace
}  // namespace poise
