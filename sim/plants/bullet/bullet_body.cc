// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/bullet/bullet_body.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "poise/robot/finding.h"

namespace poise {

static_assert(sizeof(btScalar) == sizeof(double), "link bullet-float64");

namespace {

btQuaternion ToQuaternion(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}

// Returns the frame L at the center of mass of a body B, along B's principal
// axes.
Pose PrincipalFrame(const Inertia& M_B) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(M_B.I_G_B);
  Eigen::Matrix3d R_BL = axes.eigenvectors();
  if (R_BL.determinant() < 0) R_BL.col(2) *= -1;
  return {R_BL, M_B.p_BoG_B};
}

btVector3 PrincipalInertia(const Inertia& M_B, const Eigen::Matrix3d& R_BL) {
  return ToBullet((R_BL.transpose() * M_B.I_G_B * R_BL).diagonal());
}

void Validate(const Tree& tree) {
  for (const Joint& joint : tree.joints()) {
    if (joint.armature != 0) {
      throw std::invalid_argument(
          "joint " + Quoted(joint.name) + ": armature is " +
          PrintNumber(joint.armature) + ", must be 0 in a Bullet plant");
    }
  }
  for (int i = 0; i < tree.num_bodies(); ++i) {
    if (tree.inertias()[i].mass > 0) continue;
    const std::string name =
        i == 0 ? "base" : "body moved by " + Quoted(tree.joints()[i - 1].name);
    throw std::invalid_argument(name + ": mass is " +
                                PrintNumber(tree.inertias()[i].mass) +
                                ", must be positive in a Bullet plant");
  }
}

}  // namespace

btVector3 ToBullet(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

btTransform ToBullet(const Pose& X) {
  return btTransform(ToQuaternion(X.R), ToBullet(X.p));
}

Eigen::Vector3d FromBullet(const btVector3& p) { return {p.x(), p.y(), p.z()}; }

Eigen::Matrix3d FromBullet(const btQuaternion& q) {
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).toRotationMatrix();
}

BulletBody::BulletBody(const Tree& tree)
    : floating_(tree.is_floating()), num_joints_(tree.num_joints()) {
  Validate(tree);
  for (const Inertia& M : tree.inertias()) {
    X_BL_.push_back(PrincipalFrame(M));
  }
  const Inertia& M_0 = tree.inertias()[0];
  body_ = std::make_unique<btMultiBody>(
      num_joints_, M_0.mass, PrincipalInertia(M_0, X_BL_[0].R), !floating_,
      /* canSleep */ false);
  for (int j = 0; j < num_joints_; ++j) {
    const Joint& joint = tree.joints()[j];
    const Inertia& M = tree.inertias()[j + 1];
    const Pose& X_BL = X_BL_[j + 1];
    // The joint frame F in the parent's Bullet frame K; at q = 0 the body's own
    // frame B is F.
    const Pose X_KF = X_BL_[joint.parent].Inverse() * joint.X_PF;
    const btQuaternion R_LK = ToQuaternion((X_KF.R * X_BL.R).transpose());
    const btVector3 axis_L = ToBullet(X_BL.R.transpose() * joint.axis_F);
    const btVector3 p_KF_K = ToBullet(X_KF.p);
    const btVector3 p_FL_L = ToBullet(X_BL.R.transpose() * X_BL.p);
    const btVector3 inertia = PrincipalInertia(M, X_BL.R);
    const int parent = joint.parent - 1;
    if (joint.type == JointType::kPrismatic) {
      body_->setupPrismatic(j, M.mass, inertia, parent, R_LK, axis_L, p_KF_K,
                            p_FL_L, /* disableParentCollision */ true);
    } else {
      body_->setupRevolute(j, M.mass, inertia, parent, R_LK, axis_L, p_KF_K,
                           p_FL_L, /* disableParentCollision */ true);
    }
  }
  body_->finalizeMultiDof();
  // A floating base is put in its place by SetState().
  body_->setBaseWorldTransform(ToBullet(X_BL_[0]));
}

void BulletBody::SetState(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  if (floating_) {
    const Pose X_WB{
        Eigen::Quaterniond(q.segment<4>(3)).normalized().toRotationMatrix(),
        q.head<3>()};
    const Pose X_WL = X_WB * X_BL_[0];
    body_->setBasePos(ToBullet(X_WL.p));
    body_->setWorldToBaseRot(ToQuaternion(X_WL.R.transpose()));
    const Eigen::Vector3d w_WB_W = v.head<3>();
    body_->setBaseOmega(ToBullet(w_WB_W));
    body_->setBaseVel(
        ToBullet(v.segment<3>(3) + w_WB_W.cross(X_WB.R * X_BL_[0].p)));
  }
  for (int j = 0; j < num_joints_; ++j) {
    body_->setJointPos(j, q[q.size() - num_joints_ + j]);
    body_->setJointVel(j, v[v.size() - num_joints_ + j]);
  }
}

void BulletBody::GetState(Eigen::VectorXd* q, Eigen::VectorXd* v) const {
  if (floating_) {
    const Pose X_WL{FromBullet(body_->getWorldToBaseRot()).transpose(),
                    FromBullet(body_->getBasePos())};
    const Pose X_WB = X_WL * X_BL_[0].Inverse();
    const Eigen::Vector3d w_WB_W = FromBullet(body_->getBaseOmega());
    q->head<3>() = X_WB.p;
    q->segment<4>(3) = Eigen::Quaterniond(X_WB.R).coeffs();
    v->head<3>() = w_WB_W;
    v->segment<3>(3) =
        FromBullet(body_->getBaseVel()) - w_WB_W.cross(X_WB.R * X_BL_[0].p);
  }
  for (int j = 0; j < num_joints_; ++j) {
    (*q)[q->size() - num_joints_ + j] = body_->getJointPos(j);
    (*v)[v->size() - num_joints_ + j] = body_->getJointVel(j);
  }
}

}  // namespace poise
