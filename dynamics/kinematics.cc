// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "dynamics/kinematics.h"

#include <Eigen/Geometry>
#include <cassert>

namespace poise {

using Eigen::Vector3d;

void ComputePoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                  std::vector<Pose>* X_WB) noexcept {
  assert(q.size() == tree.nq());
  assert(static_cast<int>(X_WB->size()) == tree.num_bodies());
  X_WB->front() = Pose();
  if (tree.is_floating()) {
    X_WB->front().R = Eigen::Quaterniond(q[6], q[3], q[4], q[5])
                          .normalized()
                          .toRotationMatrix();
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
                       std::vector<Vector6d>* V_WB_W) noexcept {
  assert(v.size() == tree.nv());
  assert(static_cast<int>(V_WB_W->size()) == tree.num_bodies());
  V_WB_W->front().setZero();
  if (tree.is_floating()) V_WB_W->front() = v.head<6>();
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const Vector3d relative =
        v[tree.v_start() + j] * (X_WB[j + 1].R * joint.axis_F);
    const Vector3d p_PB_W = X_WB[j + 1].p - X_WB[joint.parent].p;
    const Vector6d& V_WP = (*V_WB_W)[joint.parent];
    const Vector3d w_WP = V_WP.head<3>();
    Vector6d& V_WB = (*V_WB_W)[j + 1];
    V_WB << w_WP, V_WP.tail<3>() + w_WP.cross(p_PB_W);
    if (joint.type == JointType::kPrismatic) {
      V_WB.tail<3>() += relative;
    } else {
      V_WB.head<3>() += relative;
    }
  }
}

void ComputeAccelerations(const Tree& tree, const std::vector<Pose>& X_WB,
                          const std::vector<Vector6d>& V_WB_W,
                          const Eigen::Ref<const Eigen::VectorXd>& v,
                          const Eigen::Ref<const Eigen::VectorXd>& vdot,
                          std::vector<Vector6d>* A_WB_W) noexcept {
  assert(v.size() == tree.nv() && vdot.size() == tree.nv());
  assert(static_cast<int>(A_WB_W->size()) == tree.num_bodies());
  A_WB_W->front().setZero();
  if (tree.is_floating()) A_WB_W->front() = vdot.head<6>();
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    const Vector3d axis_W = X_WB[j + 1].R * joint.axis_F;
    const double v_j = v[tree.v_start() + j];
    const double vdot_j = vdot[tree.v_start() + j];
    const Vector3d p_PB_W = X_WB[j + 1].p - X_WB[joint.parent].p;
    const Vector3d w_WP = V_WB_W[joint.parent].head<3>();
    const Vector6d& A_WP = (*A_WB_W)[joint.parent];
    const Vector3d alpha_WP = A_WP.head<3>();
    Vector6d& A_WB = (*A_WB_W)[j + 1];
    A_WB << alpha_WP, A_WP.tail<3>() + alpha_WP.cross(p_PB_W) +
                          w_WP.cross(w_WP.cross(p_PB_W));
    if (joint.type == JointType::kPrismatic) {
      A_WB.tail<3>() += vdot_j * axis_W + 2 * v_j * w_WP.cross(axis_W);
    } else {
      A_WB.head<3>() += vdot_j * axis_W + v_j * w_WP.cross(axis_W);
    }
  }
}

Pose FramePose(const Tree& tree, const std::vector<Pose>& X_WB,
               int frame) noexcept {
  const Frame& F = tree.frames()[frame];
  return X_WB[F.body] * F.X_BF;
}

Vector6d FrameVelocity(const Tree& tree, const std::vector<Pose>& X_WB,
                       const std::vector<Vector6d>& V_WB_W,
                       int frame) noexcept {
  const Frame& F = tree.frames()[frame];
  const Vector3d p_BF_W = X_WB[F.body].R * F.X_BF.p;
  Vector6d V_WF = V_WB_W[F.body];
  V_WF.tail<3>() += V_WF.head<3>().cross(p_BF_W);
  return V_WF;
}

Vector6d FrameAcceleration(const Tree& tree, const std::vector<Pose>& X_WB,
                           const std::vector<Vector6d>& V_WB_W,
                           const std::vector<Vector6d>& A_WB_W,
                           int frame) noexcept {
  const Frame& F = tree.frames()[frame];
  const Vector3d p_BF_W = X_WB[F.body].R * F.X_BF.p;
  const Vector3d w_WB = V_WB_W[F.body].head<3>();
  Vector6d A_WF = A_WB_W[F.body];
  A_WF.tail<3>() +=
      A_WF.head<3>().cross(p_BF_W) + w_WB.cross(w_WB.cross(p_BF_W));
  return A_WF;
}

}  // namespace poise
