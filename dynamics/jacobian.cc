// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/jacobian.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/math/so3.h"

namespace poise {

using Eigen::Vector3d;

void ComputeFrameJacobian(const Tree& tree, const std::vector<Pose>& X_WB,
                          int frame, Axes axes,
                          Eigen::Ref<Matrix6Xd> J_WF) noexcept {
  assert(J_WF.cols() == tree.nv());
  const Frame& F = tree.frames()[frame];
  const Pose X_WF = X_WB[F.body] * F.X_BF;
  J_WF.setZero();
  for (int b = F.body; b > 0; b = tree.joints()[b - 1].parent) {
    const Joint& joint = tree.joints()[b - 1];
    const Vector3d axis_W = X_WB[b].R * joint.axis_F;
    auto column = J_WF.col(tree.v_start() + b - 1);
    if (joint.type == JointType::kPrismatic) {
      column.tail<3>() = axis_W;
    } else {
      column.head<3>() = axis_W;
      column.tail<3>() = axis_W.cross(X_WF.p - X_WB[b].p);
    }
  }
  if (tree.is_floating()) {
    J_WF.leftCols<6>().setIdentity();
    J_WF.block<3, 3>(3, 0) = -Hat(X_WF.p - X_WB[0].p);
  }
  if (axes == Axes::kFrame) {
    for (int j = 0; j < tree.nv(); ++j) {
      J_WF.col(j).head<3>() = X_WF.R.transpose() * J_WF.col(j).head<3>();
      J_WF.col(j).tail<3>() = X_WF.R.transpose() * J_WF.col(j).tail<3>();
    }
  }
}

Vector6d FrameBias(const SpatialAcceleration& A_WF_W,
                   const SpatialMotion& V_WF_W, const Eigen::Matrix3d& R_WF,
                   Axes axes) noexcept {
  if (axes == Axes::kWorld) return A_WF_W.vector();
  // w x w is zero.
  const SpatialAcceleration turned(Vector3d::Zero(),
                                   V_WF_W.angular.cross(V_WF_W.linear));
  const Eigen::Matrix3d R_FW = R_WF.transpose();
  return (R_FW * (A_WF_W - turned)).vector();
}

}  // namespace poise
