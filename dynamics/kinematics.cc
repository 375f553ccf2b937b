// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/kinematics.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/math/quaternion.h"

namespace poise {

using Eigen::Vector3d;

void ComputePoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                  std::vector<Pose>* X_WB) noexcept {
  assert(q.size() == tree.nq());
  assert(static_cast<int>(X_WB->size()) == tree.num_bodies());
  X_WB->front() = Pose();
  if (tree.is_floating()) {
    X_WB->front().R = MatrixFromQuaternion(
        Normalize(Eigen::Quaterniond(q[6], q[3], q[4], q[5])));
    X_WB->front().p = q.head<3>();
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const double q_j = q[tree.q_start() + j];
    Pose X_FB;
    if (joint.type == JointType::kPrismatic) {
      X_FB.p = q_j * joint.axis_F;
    } else {
      X_FB.R = Eigen::AngleAxisd(q_j, joint.axis_F).toRotationMatrix();
    }
    (*X_WB)[j + 1] = (*X_WB)[joint.parent] * joint.X_PF * X_FB;
  }
}

void ComputeVelocities(const Tree& tree, const std::vector<Pose>& X_WB,
                       const Eigen::Ref<const Eigen::VectorXd>& v,
                       std::vector<SpatialMotion>* V_WB_W) noexcept {
  assert(v.size() == tree.nv());
  assert(static_cast<int>(V_WB_W->size()) == tree.num_bodies());
  V_WB_W->front() = SpatialMotion();
  if (tree.is_floating()) V_WB_W->front() = SpatialMotion(v.head<6>());
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const Vector3d relative =
        v[tree.v_start() + j] * (X_WB[j + 1].R * joint.axis_F);
    const Vector3d p_PB_W = X_WB[j + 1].p - X_WB[joint.parent].p;
    SpatialMotion& V_WB = (*V_WB_W)[j + 1];
    V_WB = Shift((*V_WB_W)[joint.parent], p_PB_W);
    if (joint.type == JointType::kPrismatic) {
      V_WB.linear += relative;
    } else {
      V_WB.angular += relative;
    }
  }
}

void ComputeAccelerations(const Tree& tree, const std::vector<Pose>& X_WB,
                          const std::vector<SpatialMotion>& V_WB_W,
                          const Eigen::Ref<const Eigen::VectorXd>& v,
                          const Eigen::Ref<const Eigen::VectorXd>& vdot,
                          std::vector<SpatialAcceleration>* A_WB_W) noexcept {
  assert(v.size() == tree.nv() && vdot.size() == tree.nv());
  assert(static_cast<int>(A_WB_W->size()) == tree.num_bodies());
  A_WB_W->front() = SpatialAcceleration();
  if (tree.is_floating()) A_WB_W->front() = SpatialAcceleration(vdot.head<6>());
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const Vector3d axis_W = X_WB[j + 1].R * joint.axis_F;
    const double v_j = v[tree.v_start() + j];
    const double vdot_j = vdot[tree.v_start() + j];
    const Vector3d p_PB_W = X_WB[j + 1].p - X_WB[joint.parent].p;
    const SpatialMotion& V_WP = V_WB_W[joint.parent];
    SpatialAcceleration& A_WB = (*A_WB_W)[j + 1];
    A_WB = Shift((*A_WB_W)[joint.parent], V_WP, p_PB_W);
    const Vector3d turned = v_j * V_WP.angular.cross(axis_W);
    if (joint.type == JointType::kPrismatic) {
      A_WB.linear += vdot_j * axis_W + 2 * turned;
    } else {
      A_WB.angular += vdot_j * axis_W + turned;
    }
  }
}

Pose FramePose(const Tree& tree, const std::vector<Pose>& X_WB,
               int frame) noexcept {
  const Frame& F = tree.frames()[frame];
  return X_WB[F.body] * F.X_BF;
}

SpatialMotion FrameVelocity(const Tree& tree, const std::vector<Pose>& X_WB,
                            const std::vector<SpatialMotion>& V_WB_W,
                            int frame) noexcept {
  const Frame& F = tree.frames()[frame];
  return Shift(V_WB_W[F.body], X_WB[F.body].R * F.X_BF.p);
}

SpatialAcceleration FrameAcceleration(
    const Tree& tree, const std::vector<Pose>& X_WB,
    const std::vector<SpatialMotion>& V_WB_W,
    const std::vector<SpatialAcceleration>& A_WB_W, int frame) noexcept {
  const Frame& F = tree.frames()[frame];
  return Shift(A_WB_W[F.body], V_WB_W[F.body], X_WB[F.body].R * F.X_BF.p);
}

}  // namespace poise
