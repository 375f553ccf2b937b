// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/kdl_tree.h"

#include <stdexcept>
#include <string>

namespace poise {
namespace {

KDL::Vector ToKdl(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

KDL::RigidBodyInertia ToKdl(const Inertia& M) {
  const Eigen::Matrix3d& I = M.I_G_B;
  // KDL's inertia is about the origin of the frame: the product with a frame
  // shifts it there from the center of mass.
  const KDL::RigidBodyInertia about_G(
      M.mass, KDL::Vector::Zero(),
      KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
                             I(1, 2)));
  return KDL::Frame(ToKdl(M.p_BoG_B)) * about_G;
}

}  // namespace

std::string KdlBodyName(int body) { return "body" + std::to_string(body); }

KDL::Tree MakeKdlTree(const Tree& tree) {
  KDL::Tree kdl("world");
  std::string base = "world";
  if (tree.is_floating()) {
    const KDL::Joint::JointType types[] = {
        KDL::Joint::TransX, KDL::Joint::TransY, KDL::Joint::TransZ,
        KDL::Joint::RotX,   KDL::Joint::RotY,   KDL::Joint::RotZ};
    for (int i = 0; i < 6; ++i) {
      const std::string name = "base" + std::to_string(i);
      const bool last = i == 5;
      kdl.addSegment(
          KDL::Segment(
              last ? KdlBodyName(0) : name, KDL::Joint(name, types[i]),
              KDL::Frame::Identity(),
              last ? ToKdl(tree.inertias()[0]) : KDL::RigidBodyInertia::Zero()),
          base);
      base = name;
    }
  } else {
    kdl.addSegment(
        KDL::Segment(KdlBodyName(0), KDL::Joint("base"), KDL::Frame::Identity(),
                     ToKdl(tree.inertias()[0])),
        base);
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const Eigen::Matrix3d& R = joint.X_PF.R;
    const KDL::Frame X_PF(
        KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2),
                      R(2, 0), R(2, 1), R(2, 2)),
        ToKdl(joint.X_PF.p));
    const KDL::Joint moving(joint.name, X_PF.p, X_PF.M * ToKdl(joint.axis_F),
                            joint.type == JointType::kPrismatic
                                ? KDL::Joint::TransAxis
                                : KDL::Joint::RotAxis,
                            1, 0, joint.armature);
    if (!kdl.addSegment(KDL::Segment(KdlBodyName(j + 1), moving, X_PF,
                                     ToKdl(tree.inertias()[j + 1])),
                        KdlBodyName(joint.parent))) {
      throw std::runtime_error("KDL rejects joint " + joint.name);
    }
  }
  return kdl;
}

std::vector<int> KdlJoints(const Tree& tree, const KDL::Tree& kdl) {
  std::vector<int> numbers;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const auto segment = kdl.getSegment(KdlBodyName(j + 1));
    numbers.push_back(static_cast<int>(GetTreeElementQNr(segment->second)));
  }
  return numbers;
}

}  // namespace poise
