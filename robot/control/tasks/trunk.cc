// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/trunk.h"

#include "poise/math/so3.h"
#include "poise/robot/control/tasks/loop_closure.h"

namespace poise {
namespace {

// The ratio is below 0.14 or above 0.17 in each of 138 URDF files that were
// tried.
constexpr double kLightBase = 1.0 / 6;

// Returns, by body, whether the body is part of a leg or hangs on one. A body
// that carries both feet, as the torso of a robot whose base is a hand, is
// none.
std::vector<bool> FindLegBodies(const Tree& tree,
                                const std::vector<Foot>& feet) {
  std::vector<int> carried(tree.num_bodies(), 0);  // Feet that a body carries.
  for (const Foot& foot : feet) {
    for (const int j : JointsTo(tree, foot.body)) ++carried[j + 1];
  }
  std::vector<bool> is_leg(tree.num_bodies(), false);
  for (int b = 0; b < tree.num_bodies(); ++b) is_leg[b] = carried[b] == 1;
  for (int j = 0; j < tree.num_joints(); ++j) {
    if (is_leg[tree.joints()[j].parent]) is_leg[j + 1] = true;
  }
  return is_leg;
}

}  // namespace

int FindTrunk(const Tree& tree, const std::vector<Foot>& feet) {
  const std::vector<bool> is_leg = FindLegBodies(tree, feet);
  const auto moment = [&](int body) {
    return tree.inertias()[body].I_G_B.trace();
  };
  int heaviest = 0;
  for (int body = 1; body < tree.num_bodies(); ++body) {
    if (!is_leg[body] && moment(body) > moment(heaviest)) heaviest = body;
  }
  return moment(0) < kLightBase * moment(heaviest) ? heaviest : 0;
}

TrunkReference::TrunkReference(const Tree& tree, int body) {
  const std::vector<int> from_body = JointsTo(tree, body);
  for (auto j = from_body.rbegin(); j != from_body.rend(); ++j) {
    const Joint& joint = tree.joints()[*j];
    const bool rotates = joint.type != JointType::kPrismatic;
    joints_.push_back({*j, joint.X_PF.R, Eigen::Vector3d::Zero()});
    if (rotates) joints_.back().axis_F = joint.axis_F;
  }
}

Eigen::Matrix3d TrunkReference::Orientation(
    const Reference& reference) const noexcept {
  Eigen::Matrix3d R_WT = reference.R_WB;
  for (const RotatingJoint& each : joints_) {
    R_WT =
        R_WT * each.R_PF * ExpSo3(reference.posture[each.joint] * each.axis_F);
  }
  return R_WT;
}

}  // namespace poise
