// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/check_bodies.h"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace poise
