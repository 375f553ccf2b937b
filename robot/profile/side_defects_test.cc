// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/side_defects.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "poise/math/rpy.h"
#include "poise/robot/feet/parts_fixture.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

const std::string kSole = ShapeAt("box size='0.2 0.1 0.02'", {0.03, 0, -0.04});

std::vector<Part> MakeLegs(const std::string& left, const std::string& right) {
  return Joined({MakeLeg({left, {0, 0.1, 0}, 0.8, kSole, true}),
                 MakeLeg({right, {0, -0.1, 0}, 0.8, kSole, true})});
}

// Returns the findings about a robot with a profile, as "where: what" in lines.
std::string Findings(const std::string& urdf, const std::string& profile = "") {
  std::vector<Finding> findings;
  const Profile read = profile.empty()
                           ? Profile{}
                           : LoadProfile(TestFile("profile.yaml", profile));
  LoadRobot(TestFile("robot.urdf", urdf), read, &findings);
  std::string text;
  for (const Finding& finding : findings) {
    if (finding.severity != Severity::kWarn) continue;
    text += finding.where + ": " + finding.what + "\n";
  }
  return text;
}

TEST(FindSideDefects, AcceptsFeetSideBySide) {
  EXPECT_EQ(Findings(UrdfOf(MakeLegs("left_", "right_"))), "");
}

TEST(FindSideDefects, WarnsIfTheLineBetweenTheFeetIsOffTheYAxis) {
  const auto yawed = [](double degrees) {
    return UrdfOf(MakeLegs("left_", "right_"),
                  MatrixFromRpy({0, 0, degrees * M_PI / 180}));
  };
  EXPECT_EQ(Findings(yawed(14)), "");
  EXPECT_EQ(Findings(yawed(-14)), "");
  const std::string warning = Findings(yawed(37));
  EXPECT_NE(warning.find("forward direction: is taken as +x of link 'trunk', "
                         "but the line between the feet is 37 degrees off"),
            std::string::npos)
      << warning;
  EXPECT_NE(Findings(yawed(-37)).find("37 degrees off"), std::string::npos);
  EXPECT_EQ(Findings(yawed(37), "forward: +x\n"), "");
}

TEST(FindSideDefects, WarnsIfTheProfileContradictsTheNames) {
  const std::string urdf = UrdfOf(MakeLegs("left_", "right_"));
  EXPECT_EQ(Findings(urdf, "forward: +x\n"), "");
  EXPECT_EQ(Findings(urdf, "left: left_foot\nright: right_foot\n"), "");
  const std::string swapped =
      "left and right: are swapped in the profile: left_foot is 'right_foot', "
      "right_foot is 'left_foot'\n";
  EXPECT_EQ(Findings(urdf, "forward: -x\n"), swapped);
  EXPECT_EQ(Findings(urdf, "left: right_foot\nright: left_foot\n"), swapped);
  // Names without sides contradict nothing.
  EXPECT_EQ(Findings(UrdfOf(MakeLegs("p_", "q_")), "forward: -x\n"), "");
}

TEST(FindSideDefects, WarnsIfTheProfileGivesHandsAsFeet) {
  const auto parts =
      Joined({MakeLegs("left_", "right_"),
              MakeArm({"left_", {0, 0.3, 0.5}, 0.6, kSole, true}),
              MakeArm({"right_", {0, -0.3, 0.5}, 0.6, kSole, true})});
  const std::string soles =
      "feet:\n  left_foot: {frame: left_hand, size: [0.1, 0.05]}\n"
      "  right_foot: {frame: right_hand, size: [0.1, 0.05]}\n";
  EXPECT_EQ(Findings(UrdfOf(parts), soles),
            "left_foot: is at the end of an arm, by the names from link "
            "'left_shoulder' to link 'left_hand'\n"
            "right_foot: is at the end of an arm, by the names from link "
            "'right_shoulder' to link 'right_hand'\n");
}

TEST(FindSideDefects, LeavesOutTheSharedPartOfTheChains) {
  // Both legs hang from a waist, whose name is that of an arm.
  auto parts =
      Joined({{{"arm", "trunk", {0, 0, 0}, {0, 0, 1}}},
              MakeLeg({"left_", {0, 0.1, 0}, 0.8, kSole, true, "arm"}),
              MakeLeg({"right_", {0, -0.1, 0}, 0.8, kSole, true, "arm"})});
  EXPECT_EQ(Findings(UrdfOf(parts), "left: left_foot\nright: right_foot\n"),
            "");
}

}  // namespace
}  // namespace poise
