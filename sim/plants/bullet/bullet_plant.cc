// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/bullet/bullet_plant.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace poise {

namespace {

// Returns the mean acceleration of the base over a step. The base's origin is
// at r_W from its center of mass L. Bullet integrates the velocity of L, and
// uses the acceleration at the start of the step.
Eigen::Matrix<double, 6, 1> BaseAcceleration(const Eigen::Vector3d& w_W,
                                             const Eigen::Vector3d& dw_W,
                                             const Eigen::Vector3d& dv_L_W,
                                             const Eigen::Vector3d& r_W,
                                             double dt) {
  const Eigen::Vector3d alpha_W = dw_W / dt;
  Eigen::Matrix<double, 6, 1> A_WB_W;
  A_WB_W << alpha_W,
      dv_L_W / dt + alpha_W.cross(r_W) + w_W.cross(w_W.cross(r_W));
  return A_WB_W;
}

}  // namespace

BulletPlant::BulletPlant(const Robot& robot, const PlantSettings& settings,
                         const BulletSettings& bullet)
    : robot_(robot),
      settings_(settings),
      bullet_(bullet),
      drag_(robot, settings.dt) {
  Validate(settings);
  const Tree& tree = robot_.model.tree;
  state_.q.resize(tree.nq());
  state_.v.resize(tree.nv());
  state_.vdot.resize(tree.nv());
  state_.tau.resize(tree.num_joints());
  state_.F_Co_C.resize(robot_.feet.size());
  X_WC_.resize(robot_.feet.size());
  state_.contact_points.resize(robot_.feet.size());
  Reset(tree.MakeNeutral(), Eigen::VectorXd::Zero(tree.nv()));
}

void BulletPlant::Reset(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  world_.reset();
  world_ = std::make_unique<BulletWorld>(robot_, settings_, bullet_);
  world_->body().SetState(q, v);
  world_->Place();
  state_.time = 0;
  state_.q = q;
  state_.v = v;
  state_.vdot.setZero();
  state_.tau.setZero();
  for (auto& F_Co_C : state_.F_Co_C) F_Co_C.setZero();
  for (int& points : state_.contact_points) points = 0;
  state_.other_force_W.setZero();
  state_.self_contacts.clear();
  steps_ = 0;
}

void BulletPlant::Apply(const AppliedForce& force) {
  btMultiBody& body = world_->body().body();
  const Pose& X_BL = world_->body().X_BL(force.body);
  // Bullet takes a force at the link's center of mass.
  const Eigen::Vector3d p_LQ_W =
      world_->X_WL(force.body).R * (X_BL.Inverse() * force.p_BoQ_B);
  const btVector3 force_W = ToBullet(force.force_W);
  const btVector3 torque_W =
      ToBullet(force.torque_W + p_LQ_W.cross(force.force_W));
  if (force.body == 0) {
    body.addBaseForce(force_W);
    body.addBaseTorque(torque_W);
  } else {
    body.addLinkForce(force.body - 1, force_W);
    body.addLinkTorque(force.body - 1, torque_W);
  }
}

void BulletPlant::Step(const Eigen::VectorXd& tau) {
  btMultiBody& body = world_->body().body();
  for (int j = 0; j < tau.size(); ++j) {
    const double limit = settings_.torque_scale * robot_.model.limits[j].effort;
    state_.tau[j] = std::clamp(tau[j], -limit, limit);
    body.addJointTorque(j, state_.tau[j]);
  }
  if (settings_.joint_damping && drag_.exists()) {
    const Eigen::VectorXd& drag = drag_.Compute(state_, state_.tau);
    for (int j = 0; j < drag.size(); ++j) body.addJointTorque(j, drag[j]);
  }
  const btVector3 w_W = body.getBaseOmega();
  const btVector3 v_L_W = body.getBaseVel();
  const Eigen::Vector3d p_LB_W =
      world_->X_WL(0).R * world_->body().X_BL(0).Inverse().p;
  for (size_t i = 0; i < robot_.feet.size(); ++i) {
    const int foot = robot_.feet[i].body;
    X_WC_[i] = world_->X_WL(foot) * world_->body().X_BL(foot).Inverse() *
               robot_.feet[i].X_BC;
  }
  const int n = robot_.model.tree.num_joints();
  state_.vdot.tail(n) = -state_.v.tail(n);

  world_->Step(settings_.dt);

  state_.time = ++steps_ * settings_.dt;
  world_->body().GetState(&state_.q, &state_.v);
  state_.vdot.tail(n) = (state_.vdot.tail(n) + state_.v.tail(n)) / settings_.dt;
  if (robot_.model.tree.is_floating()) {
    state_.vdot.head<6>() = BaseAcceleration(
        FromBullet(w_W), FromBullet(body.getBaseOmega() - w_W),
        FromBullet(body.getBaseVel() - v_L_W), p_LB_W, settings_.dt);
  }
  ReadContacts();
}

void BulletPlant::ReadContacts() {
  for (auto& F_Co_C : state_.F_Co_C) F_Co_C.setZero();
  for (int& points : state_.contact_points) points = 0;
  state_.other_force_W.setZero();
  for (const GroundContact& contact :
       world_->FindGroundContacts(settings_.dt)) {
    const auto foot = std::find_if(
        robot_.feet.begin(), robot_.feet.end(),
        [&contact](const Foot& f) { return f.body == contact.body; });
    if (foot == robot_.feet.end()) {
      state_.other_force_W += contact.force_W;
      continue;
    }
    const int i = static_cast<int>(foot - robot_.feet.begin());
    const Eigen::Vector3d force_C = X_WC_[i].R.transpose() * contact.force_W;
    const Eigen::Vector3d p_CQ_C = X_WC_[i].Inverse() * contact.p_WQ;
    state_.F_Co_C[i].head<3>() += p_CQ_C.cross(force_C);
    state_.F_Co_C[i].tail<3>() += force_C;
    ++state_.contact_points[i];
  }
  world_->FindSelfContacts(&state_.self_contacts);
}

}  // namespace poise
