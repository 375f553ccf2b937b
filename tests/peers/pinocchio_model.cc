// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/pinocchio_model.h"

namespace poise {
namespace {

namespace pin = pinocchio;

pin::SE3 ToPinocchio(const Pose& X) { return {X.R, X.p}; }

pin::Inertia ToPinocchio(const Inertia& M) {
  return {M.mass, M.p_BoG_B, pin::Symmetric3(M.I_G_B)};
}

// Adds a joint, of a type of its own where the axis is one of the frame's: that
// is what Pinocchio's parser of URDF files does.
pin::JointIndex AddJoint(const Joint& joint, pin::JointIndex parent,
                         pin::Model* model) {
  const auto add = [&](const auto& type) {
    return model->addJoint(parent, type, ToPinocchio(joint.X_PF), joint.name);
  };
  const Eigen::Vector3d& axis = joint.axis_F;
  const int along = axis == Eigen::Vector3d::UnitX()   ? 0
                    : axis == Eigen::Vector3d::UnitY() ? 1
                    : axis == Eigen::Vector3d::UnitZ() ? 2
                                                       : 3;
  if (joint.type == JointType::kPrismatic) {
    return along == 0   ? add(pin::JointModelPX())
           : along == 1 ? add(pin::JointModelPY())
           : along == 2 ? add(pin::JointModelPZ())
                        : add(pin::JointModelPrismaticUnaligned(axis));
  }
  if (joint.type == JointType::kContinuous) {
    return along == 0   ? add(pin::JointModelRUBX())
           : along == 1 ? add(pin::JointModelRUBY())
           : along == 2 ? add(pin::JointModelRUBZ())
                        : add(pin::JointModelRevoluteUnboundedUnaligned(axis));
  }
  return along == 0   ? add(pin::JointModelRX())
         : along == 1 ? add(pin::JointModelRY())
         : along == 2 ? add(pin::JointModelRZ())
                      : add(pin::JointModelRevoluteUnaligned(axis));
}

}  // namespace

pin::Model MakePinocchioModel(const Tree& tree,
                              const std::vector<Frame>& frames) {
  pin::Model model;
  std::vector<pin::JointIndex> of_body = {0};
  if (tree.is_floating()) {
    of_body[0] = model.addJoint(0, pin::JointModelFreeFlyer(),
                                pin::SE3::Identity(), "base");
  }
  model.appendBodyToJoint(of_body[0], ToPinocchio(tree.inertias()[0]));
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    of_body.push_back(AddJoint(joint, of_body[joint.parent], &model));
    model.appendBodyToJoint(of_body.back(),
                            ToPinocchio(tree.inertias()[j + 1]));
    model.armature[tree.v_start() + j] = joint.armature;
  }
  for (const Frame& frame : frames) {
    model.addFrame(pin::Frame(frame.name, of_body[frame.body],
                              ToPinocchio(frame.X_BF), pin::OP_FRAME));
  }
  model.gravity.linear(tree.gravity_W());
  return model;
}

}  // namespace poise
