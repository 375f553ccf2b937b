// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/trunk.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "poise/dynamics/kinematics.h"
#include "poise/math/pose.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/random_tree.h"

namespace poise {
namespace {

using Eigen::VectorXd;

// A pelvis and a torso with these moments of inertia about each axis, and two
// legs with a thigh of 100 kg m2 and a foot with a toe of the same. The base is
// the pelvis, or a hand on the torso.
RobotModel WithMoments(double pelvis, double torso, bool from_hand = false) {
  std::string text = "<robot name='r'>";
  const auto link = [&](const std::string& name, double moment) {
    const std::string I = std::to_string(moment);
    text += "<link name='" + name + "'><inertial><mass value='1'/><inertia " +
            "ixx='" + I + "' ixy='0' ixz='0' iyy='" + I + "' iyz='0' izz='" +
            I + "'/></inertial></link>";
  };
  const auto joint = [&](const std::string& child, const std::string& parent) {
    text += "<joint name='" + child + "' type='continuous'><parent link='" +
            parent + "'/><child link='" + child + "'/></joint>";
  };
  link("pelvis", pelvis);
  link("torso", torso);
  if (from_hand) {
    link("hand", 0.1);
    joint("torso", "hand");
    joint("pelvis", "torso");
  } else {
    joint("torso", "pelvis");
  }
  for (const std::string side : {"l_", "r_"}) {
    link(side + "thigh", 100);
    joint(side + "thigh", "pelvis");
    link(side + "foot", 0.1);
    joint(side + "foot", side + "thigh");
    link(side + "toe", 100);
    joint(side + "toe", side + "foot");
  }
  return ParseUrdf(text + "</robot>", "r");
}

std::string TrunkOf(const RobotModel& model) {
  const Tree& tree = model.tree;
  std::vector<Foot> feet;
  for (const char* name : {"l_foot", "r_foot"}) {
    Foot foot;
    foot.frame = *tree.FindFrame(name);
    foot.body = tree.frames()[foot.frame].body;
    feet.push_back(foot);
  }
  const int trunk = FindTrunk(tree, feet);
  for (const Frame& frame : tree.frames()) {
    if (frame.body == trunk) return frame.name;
  }
  return "";
}

TEST(Trunk, IsTheBaseOrABodyOfSixTimesItsMoment) {
  EXPECT_EQ(TrunkOf(WithMoments(1, 0.5)), "pelvis");
  EXPECT_EQ(TrunkOf(WithMoments(1, 5.9)), "pelvis");
  EXPECT_EQ(TrunkOf(WithMoments(1, 6.1)), "torso");
  EXPECT_EQ(TrunkOf(WithMoments(1, 5.9, true)), "torso");
}

// Its reference orientation is the one that the forward kinematics give with
// the base at R_WB and the joints at the posture.
TEST(Trunk, HasTheOrientationOfTheForwardKinematics) {
  std::mt19937 draw(1);
  for (int i = 0; i < 30; ++i) {
    const Tree tree = MakeRandomTree(i, &draw);
    const VectorXd q = MakeRandomConfiguration(tree, &draw);
    std::vector<Pose> X_WB(tree.num_bodies());
    ComputePoses(tree, q, &X_WB);
    Reference reference;
    reference.R_WB = X_WB[0].R;
    reference.posture = q.tail(tree.num_joints());
    for (int body = 0; body < tree.num_bodies(); ++body) {
      const Eigen::Matrix3d R_WT =
          TrunkReference(tree, body).Orientation(reference);
      // Two products of rotations for each joint, each with a few roundings.
      const double tolerance =
          20 * (i + 1) * std::numeric_limits<double>::epsilon();
      EXPECT_LT((R_WT - X_WB[body].R).norm(), tolerance);
    }
  }
}

}  // namespace
}  // namespace poise
