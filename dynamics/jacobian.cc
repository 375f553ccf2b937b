// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "dynamics/jacobian.h"

#include <Eigen/Geometry>
#include <cassert>

#include "math/so3.h"

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

Vector6d FrameBias(const Vector6d& A_WF_W, const Vector6d& V_WF_W,
                   const Eigen::Matrix3d& R_WF, Axes axes) noexcept {
  if (axes == Axes::kWorld) return A_WF_W;
  const Vector3d w_WF_W = V_WF_W.head<3>();
  Vector6d bias;
  bias.head<3>() = R_WF.transpose() * A_WF_W.head<3>();
  bias.tail<3>() =
      R_WF.transpose() *
      (A_WF_W.tail<3>() - w_WF_W.cross(Vector3d(V_WF_W.tail<3>())));
  return bias;
}

}  // namespace poise
