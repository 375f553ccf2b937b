// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/leg_names.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

// Expects that the first name is the left one of the two.
void ExpectLeft(const std::string& left, const std::string& right) {
  EXPECT_EQ(CompareSides(left, right), 1) << left << " " << right;
  EXPECT_EQ(CompareSides(right, left), -1) << left << " " << right;
}

TEST(CompareSides, FindsWordsAndLetters) {
  ExpectLeft("leg_left_6_link", "leg_right_6_link");
  ExpectLeft("LeftFootPitch", "RightFootPitch");
  ExpectLeft("/left_foot", "/right_foot");
  ExpectLeft("leftfoot", "rightfoot");
  ExpectLeft("l_foot", "r_foot");
  ExpectLeft("LAnkleRoll", "RAnkleRoll");
  ExpectLeft("LLEG_JOINT5", "RLEG_JOINT5");
  ExpectLeft("ankle_L_Link", "ankle_R_Link");
  ExpectLeft("leg_l6_link", "leg_r6_link");
  ExpectLeft("ll_faa", "lr_faa");    // The second letter is the side.
  ExpectLeft("LL_FOOT", "RL_FOOT");  // Left leg, right leg.
  ExpectLeft("left_l_foot", "right_r_foot");
}

TEST(CompareSides, ComparesWordsOfNamesThatDifferElsewhere) {
  ExpectLeft("left_foot_v3", "right_foot_v4");
  ExpectLeft("foot-l (1)", "foot-r (7)");
  ExpectLeft("L.foot", "the foot R");
  ExpectLeft("Left_Foot", "foot_right");
}

TEST(CompareSides, DoesNotGuess) {
  const char* pairs[][2] = {{"foot", "foot"},     {"leg_1", "leg_2"},
                            {"rotor", "rotor_2"}, {"lever", "rotor"},
                            {"left", "left_2"},   {"l_foot", "foot_2"},
                            {"l_r_1", "r_l_1"},   {"", ""}};
  for (const auto& [a, b] : pairs) {
    EXPECT_EQ(CompareSides(a, b), 0) << a << " " << b;
  }
}

TEST(LegOrArm, KnowsThePartsOfLegsAndArms) {
  for (const char* leg :
       {"l_foot", "LHipYaw", "leg_l6", "RKNEE", "left_sole", "LLEG_JOINT0",
        "lupperleg", "ankle1", "rkneepitch", "FootL", "toes"}) {
    EXPECT_EQ(LegOrArm(leg), 1) << leg;
  }
  for (const char* arm : {"zarm_l7", "LHand", "left_shoulder_pitch", "gripper",
                          "rforearm", "UpperArmL", "RARM_JOINT1", "larm"}) {
    EXPECT_EQ(LegOrArm(arm), -1) << arm;
  }
  for (const char* other :
       {"part_3", "torso", "", "arm_or_leg", "harmony_l1", "charm", "alarm_2",
        "armor", "machine", "console", "handle_1"}) {
    EXPECT_EQ(LegOrArm(other), 0) << other;
  }
}

}  // namespace
}  // namespace poise
