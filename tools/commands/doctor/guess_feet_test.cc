// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/guess_feet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "poise/robot/urdf/urdf.h"
#include "poise/tools/commands/doctor/biped_fixture.h"

namespace poise {
namespace {

std::vector<Diagnosis::Sole> Guess(const std::string& text) {
  return GuessFeet(UrdfDocument(text, "robot.urdf").MakeModel());
}

// The fixture's ankles are 0.6 m below its root link. Shapes are not used.
TEST(GuessFeet, TakesTheLowestEndsOfChains) {
  SmallBiped biped;
  biped.has_shapes = false;
  const auto feet = Guess(TextOf(biped));
  ASSERT_EQ(feet.size(), 2u);
  EXPECT_EQ(feet[0].name, "left_foot");
  EXPECT_EQ(feet[0].link, "left_foot");
  EXPECT_EQ(feet[1].name, "right_foot");
  EXPECT_EQ(feet[1].link, "right_foot");
  for (const Diagnosis::Sole& foot : feet) {
    EXPECT_EQ(foot.from, "guess");
    EXPECT_DOUBLE_EQ(foot.length, 0.132);
    EXPECT_DOUBLE_EQ(foot.width, 0.051);
    EXPECT_DOUBLE_EQ(foot.depth, 0.06);
    // The sole is below the ankle, and reaches farther forward.
    EXPECT_DOUBLE_EQ(foot.xyz.z(), -foot.depth);
    EXPECT_GT(foot.xyz.x(), 0);
    EXPECT_EQ(foot.xyz.y(), 0);
  }
}

TEST(GuessFeet, ScalesWithTheRobot) {
  SmallBiped biped;
  const auto feet = Guess(TextOf(biped));
  biped.scale = 2;
  const auto large = Guess(TextOf(biped));
  ASSERT_EQ(large.size(), 2u);
  for (const int i : {0, 1}) {
    EXPECT_DOUBLE_EQ(large[i].length, 2 * feet[i].length);
    EXPECT_DOUBLE_EQ(large[i].width, 2 * feet[i].width);
    EXPECT_DOUBLE_EQ(large[i].depth, 2 * feet[i].depth);
    EXPECT_TRUE(large[i].xyz.isApprox(2 * feet[i].xyz));
  }
}

// The y axis decides, not the order in the file.
TEST(GuessFeet, PutsTheFootAtLargerYFirst) {
  SmallBiped biped;
  biped.left = "b_";
  biped.right = "a_";
  EXPECT_EQ(Guess(TextOf(biped)).at(0).link, "b_foot");
  biped.yaw = M_PI;
  EXPECT_EQ(Guess(TextOf(biped)).at(0).link, "a_foot");
}

TEST(GuessFeet, NeedsTwoEndsBelowTheRoot) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
      "iyz='0' izz='1'/></inertial>";
  const auto limb = [&](const std::string& name, const std::string& z) {
    return "<link name='" + name + "'>" + inertial + "</link><joint name='j" +
           name + "' type='revolute'><origin xyz='0 0 " + z +
           "'/><parent link='root'/><child link='" + name +
           "'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='9' "
           "velocity='9'/></joint>";
  };
  const std::string root =
      "<robot name='r'><link name='root'>" + inertial + "</link>";
  EXPECT_EQ(Guess(root + limb("a", "-1") + limb("b", "-1") + "</robot>").size(),
            2u);
  EXPECT_TRUE(
      Guess(root + limb("left_hand", "-1") + limb("b", "-1") + "</robot>")
          .empty());
  EXPECT_TRUE(Guess(root + limb("a", "-1") + "</robot>").empty());
  EXPECT_TRUE(
      Guess(root + limb("a", "-1") + limb("b", "1") + "</robot>").empty());
}

}  // namespace
}  // namespace poise
