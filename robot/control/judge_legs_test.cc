// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/judge_legs.h"

#include <gtest/gtest.h>

#include <string>

#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

TEST(JudgeLegs, AcceptsLegsOfSixFastJoints) {
  EXPECT_TRUE(JudgeLegs(LoadHumanoid()).empty());
}

TEST(JudgeLegs, FindsPlaceholdersOfTheVelocity) {
  Robot robot = LoadHumanoid();
  const int knee = *robot.model.tree.FindJoint("l_knee");
  robot.model.limits[knee].velocity = 0.5;
  // A slow arm does not matter for balance.
  robot.model.limits[*robot.model.tree.FindJoint("l_elbow")].velocity = 0.5;
  const std::vector<Finding> findings = JudgeLegs(robot);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::kWarn);
  EXPECT_NE(findings[0].where.find("left leg"), std::string::npos);
  EXPECT_EQ(findings[0].what,
            "has 1 velocity limit below 3 rad/s, the lowest 0.5 rad/s at joint "
            "'l_knee'");
}

// The shin counts as the sole here: a leg of four joints.
TEST(JudgeLegs, CountsTheDirectionsThatALegDoesNotControl) {
  Robot robot = LoadHumanoid();
  Foot& foot = robot.feet[1];
  const Tree& tree = robot.model.tree;
  foot.body = tree.joints()[tree.joints()[foot.body - 1].parent - 1].parent;
  const std::vector<Finding> findings = JudgeLegs(robot);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].where, "right leg");
  EXPECT_EQ(findings[0].what, "has 4 joints");
  EXPECT_EQ(findings[0].why.substr(0, 12), "2 directions");
  // It is no foot: the ankle follows.
  EXPECT_EQ(findings[1].where, "right_foot");
  EXPECT_EQ(findings[1].what, "carries a chain of 2 joints");
}

}  // namespace
}  // namespace poise
