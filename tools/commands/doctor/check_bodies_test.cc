// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/check_bodies.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <string>

#include "poise/dynamics/tree.h"
#include "poise/math/inertia.h"
#include "poise/math/pose.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

std::string Text(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) text += finding.what + "\n";
  return text;
}

TEST(CompareLegs, FindsEachDifference) {
  const Robot robot = LoadRobot("robot/models/humanoid.urdf");
  EXPECT_EQ(Text(CompareLegs(robot)), "");
  Robot odd = robot;
  odd.feet[1].half_size.y() *= 0.9;
  EXPECT_NE(Text(CompareLegs(odd)).find("the sole's width"), std::string::npos);
  odd = robot;
  odd.feet[1].X_BC.p.z() -= 0.05;
  EXPECT_NE(Text(CompareLegs(odd)).find("the sole's distance"),
            std::string::npos);
  // The right sole is on the parent of the foot: one joint less.
  odd = robot;
  odd.feet[1].body = odd.model.tree.joints()[odd.feet[1].body - 1].parent;
  const std::string found = Text(CompareLegs(odd));
  EXPECT_NE(found.find("the number of joints: 6 to"), std::string::npos)
      << found;
  EXPECT_NE(found.find("differ in mass"), std::string::npos) << found;
}

// A rod of 1 m has a radius of gyration of sqrt(1/12) = 0.289 m, and reaches
// 0.5 m from its middle.
RobotModel Rod(double factor, const std::string& geometry) {
  const std::string I = std::to_string(factor * factor / 12);
  return ParseUrdf(
      "<robot name='r'><link name='rod'><inertial><mass value='1'/><inertia "
      "ixx='" +
          I + "' ixy='0' ixz='0' iyy='" + I + "' iyz='0' izz='" + I +
          "'/></inertial><collision><geometry>" + geometry +
          "</geometry></collision></link></robot>",
      "r.urdf");
}

TEST(FindWideInertias, ComparesRadiusOfGyrationWithShapes) {
  const std::string box = "<box size='0.01 0.01 1'/>";
  EXPECT_EQ(Text(FindWideInertias(Rod(1, box))), "");
  // Beyond 0.5 m, times the tolerance of 1.5.
  EXPECT_EQ(Text(FindWideInertias(Rod(2.5, box))), "");
  const std::string found = Text(FindWideInertias(Rod(2.7, box)));
  EXPECT_EQ(found.find("has 1 body with a radius of gyration beyond its "
                       "shapes: 'rod' (0.779"),
            0u)
      << found;
}

// The humanoid with masses in grams, and with lengths in millimeters.
TEST(FindWrongUnits, ComparesMassAndSize) {
  const RobotModel model = LoadRobot("robot/models/humanoid.urdf").model;
  EXPECT_FALSE(FindWrongUnits(model));
  const auto scaled = [&](double length, double mass) {
    TreeBuilder builder;
    const Tree& tree = model.tree;
    const auto name = [](int body) { return "body" + std::to_string(body); };
    for (int b = 0; b < tree.num_bodies(); ++b) {
      Inertia M = tree.inertias()[b];
      M.mass *= mass;
      builder.AddLink(name(b), M);
    }
    for (int j = 0; j < tree.num_joints(); ++j) {
      const Joint& joint = tree.joints()[j];
      Pose X_PF = joint.X_PF;
      X_PF.p *= length;
      builder.AddJoint({joint.name, joint.type, name(joint.parent), name(j + 1),
                        X_PF, joint.axis_F, 0});
    }
    RobotModel other = model;
    other.tree = builder.Build();
    return FindWrongUnits(other);
  };
  EXPECT_FALSE(scaled(0.3, 0.027));
  EXPECT_FALSE(scaled(3, 27));
  ASSERT_TRUE(scaled(1, 1000));
  EXPECT_EQ(scaled(1, 1000)->what.find("has a mass of 38660 kg"), 0u);
  EXPECT_TRUE(scaled(1000, 1));
}

TEST(FindFarSoles, ComparesWithTheLeg) {
  Robot robot = LoadRobot("robot/models/humanoid.urdf");
  EXPECT_EQ(Text(FindFarSoles(robot)), "");
  robot.feet[1].X_BC.p.x() = 3;
  const std::string found = Text(FindFarSoles(robot));
  EXPECT_EQ(found.find("has its sole 3.00"), 0u) << found;
}

}  // namespace
}  // namespace poise
