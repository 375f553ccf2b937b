// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

std::string Link(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
         "iyy='1' iyz='0' izz='1'/></inertial></link>";
}

std::string Joint(const std::string& parent, const std::string& child,
                  double length) {
  return "<joint name='" + child + ".' type='revolute'><origin xyz='0 0 " +
         std::to_string(-length) + "'/><parent link='" + parent +
         "'/><child link='" + child +
         "'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='9' "
         "velocity='9'/></joint>";
}

// Two legs: a hip of two joints that are `hip` apart, and a shank at the end of
// a thigh. The bodies are the pelvis (0), and per leg the body in the hip, the
// thigh and the shank.
Pairs Neighbors(double hip, double thigh) {
  std::string text = "<robot name='r'>" + Link("pelvis");
  for (const std::string side : {"l", "r"}) {
    text += Link(side + "_hip") + Link(side + "_thigh") + Link(side + "_shank");
    text += Joint("pelvis", side + "_hip", 0.1);
    text += Joint(side + "_hip", side + "_thigh", hip);
    text += Joint(side + "_thigh", side + "_shank", thigh);
  }
  Pairs pairs = FindNeighbors(ParseUrdf(text + "</robot>", "r.urdf").tree);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The two hips have the same parent.
const Pairs kConnected = {{0, 1}, {0, 4}, {1, 2}, {1, 4},
                          {2, 3}, {4, 5}, {5, 6}};
const Pairs kWithThighs = {{0, 1}, {0, 2}, {0, 4}, {0, 5}, {1, 2},
                           {1, 4}, {2, 3}, {4, 5}, {5, 6}};

TEST(FindNeighbors, AreConnectedByOneJointOrByAHip) {
  EXPECT_EQ(Neighbors(0.2, 0.4), kConnected);
  EXPECT_EQ(Neighbors(0.02, 0.4), kWithThighs);
}

// A hip of 9 cm is that of a robot of 2 m, but not of one of 1 m. Motors make
// the hip of a small robot relatively long.
TEST(FindNeighbors, HaveAHipOfTheRobotsSize) {
  EXPECT_EQ(Neighbors(0.09, 1.6), kWithThighs);
  EXPECT_EQ(Neighbors(0.09, 0.5), kConnected);
  EXPECT_EQ(Neighbors(0.045, 0.1), kWithThighs);
}

}  // namespace
}  // namespace poise
