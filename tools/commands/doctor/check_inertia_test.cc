// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/check_inertia.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

constexpr char kInertial[] =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
    "iyz='0' izz='1'/></inertial>";

// Makes the chain base - j1 - a - j2 - b. Joint j1 turns about z.
RobotModel Chain(const std::string& base, const std::string& a,
                 const std::string& b, const std::string& axis2 = "0 1 0") {
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis) {
    return "<joint name='" + name + "' type='continuous'><parent link='" +
           parent + "'/><child link='" + child + "'/><axis xyz='" + axis +
           "'/><limit effort='1' velocity='1'/></joint>";
  };
  return ParseUrdf("<robot name='chain'><link name='base'>" + base +
                       "</link><link name='a'>" + a + "</link><link name='b'>" +
                       b + "</link>" + joint("j1", "base", "a", "0 0 1") +
                       joint("j2", "a", "b", axis2) + "</robot>",
                   "chain.urdf");
}

// Returns the findings of a robot whose M cannot be inverted.
std::string Findings(const RobotModel& model) {
  std::vector<Finding> findings;
  EXPECT_FALSE(CheckInertia(model, &findings).has_value());
  std::string text;
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.severity, Severity::kWarn);
    text += Message("", finding);
  }
  return text;
}

TEST(CheckInertia, NamesJointAndLinkThatMoveNoMass) {
  EXPECT_EQ(Findings(Chain(kInertial, kInertial, "")),
            ": joint 'j2': moves no mass (link 'b' and beyond), M is singular "
            "or indefinite: no acceleration can be computed");
  EXPECT_EQ(Findings(Chain(kInertial, "", "")),
            ": joint 'j1': moves no mass (link 'a' and beyond), M is singular "
            "or indefinite: no acceleration can be computed");
}

TEST(CheckInertia, NamesOneOfTwoJointsThatMoveTheSameMass) {
  const std::string found = Findings(Chain(kInertial, "", kInertial, "0 0 1"));
  EXPECT_NE(found.find("makes M singular"), std::string::npos) << found;
}

TEST(CheckInertia, AcceptsMasslessLinkBetweenJoints) {
  std::vector<Finding> findings;
  const auto smallest =
      CheckInertia(Chain(kInertial, "", kInertial), &findings);
  EXPECT_TRUE(findings.empty());
  // Both bodies have their mass at the same point. The smallest eigenvalue is
  // that of the block of M for j1 and the rotation of the base about z. Scaled,
  // this block is [1 r; r 1] with r = sqrt(1/2).
  EXPECT_NEAR(smallest.value(), 1 - std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace poise
