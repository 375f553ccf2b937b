// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "dynamics/tick.h"

#include <Eigen/Geometry>
#include <cassert>

#include "math/so3.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector6d Stack(const Vector3d& angular, const Vector3d& linear) {
  Vector6d result;
  result << angular, linear;
  return result;
}

// Motion vectors' cross product.
Vector6d CrossMotion(const Vector6d& V, const Vector6d& S) {
  const Vector3d w = V.head<3>(), v = V.tail<3>();
  const Vector3d w_S = S.head<3>(), v_S = S.tail<3>();
  return Stack(w.cross(w_S), w.cross(v_S) + v.cross(w_S));
}

// The rate of a momentum L carried along by a motion V.
Vector6d CrossMomentum(const Vector6d& V, const Vector6d& L) {
  const Vector3d w = V.head<3>(), v = V.tail<3>();
  const Vector3d n = L.head<3>(), f = L.tail<3>();
  return Stack(w.cross(n) + v.cross(f), w.cross(f));
}

}  // namespace

Tick::Tick(const Tree& tree, const std::vector<int>& frame_indices)
    : M(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      N(Eigen::VectorXd::Zero(tree.nv())),
      c(Eigen::VectorXd::Zero(tree.nv())),
      X_WB(tree.num_bodies()),
      H_G(6, tree.nv()),
      S_(6, tree.num_joints()),
      V_(tree.num_bodies()),
      A_(tree.num_bodies()),
      I_(tree.num_bodies()),
      F_(tree.num_bodies()) {
  for (const int frame : frame_indices) {
    frames.push_back({frame, Pose(), Vector6d::Zero(),
                      Eigen::MatrixXd::Zero(6, tree.nv()), Vector6d::Zero()});
  }
}

void ComputeTick(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 Tick* tick) noexcept {
  assert(q.size() == tree.nq() && v.size() == tree.nv());
  const int num_bodies = tree.num_bodies();
  const int n = tree.num_joints();
  const int v0 = tree.v_start();
  const int q0 = tree.q_start();

  // All spatial quantities have world axes and are about one point O, the
  // origin of the base, taken as fixed in the world.
  tick->X_WB[0] = Pose();
  tick->V_[0].setZero();
  tick->A_[0].setZero();
  if (tree.is_floating()) {
    tick->X_WB[0].R = Eigen::Quaterniond(q[6], q[3], q[4], q[5])
                          .normalized()
                          .toRotationMatrix();
    tick->X_WB[0].p = q.head<3>();
    tick->V_[0] = v.head<6>();
    const Vector3d w_WB = v.head<3>(), v_WB = v.segment<3>(3);
    tick->A_[0].tail<3>() = -w_WB.cross(v_WB);
  }
  const Vector3d p_WO = tick->X_WB[0].p;

  for (int j = 0; j < n; ++j) {
    const Joint& joint = tree.joints()[j];
    const int parent = joint.parent;
    const Pose X_WF = tick->X_WB[parent] * joint.X_PF;
    const Vector3d axis_W = X_WF.R * joint.axis_F;
    Pose& X_WB = tick->X_WB[j + 1];
    X_WB = X_WF;
    if (joint.type == JointType::kPrismatic) {
      X_WB.p += q[q0 + j] * axis_W;
      tick->S_.col(j) = Stack(Vector3d::Zero(), axis_W);
    } else {
      X_WB.R = X_WF.R *
               Eigen::AngleAxisd(q[q0 + j], joint.axis_F).toRotationMatrix();
      tick->S_.col(j) = Stack(axis_W, (X_WF.p - p_WO).cross(axis_W));
    }
    const Vector6d S_qd = tick->S_.col(j) * v[v0 + j];
    tick->V_[j + 1] = tick->V_[parent] + S_qd;
    tick->A_[j + 1] = tick->A_[parent] + CrossMotion(tick->V_[parent], S_qd);
  }

  for (int b = 0; b < num_bodies; ++b) {
    const Inertia& M_B = tree.inertias()[b];
    const Pose& X_WB = tick->X_WB[b];
    const Vector3d p_OG = X_WB * M_B.p_BoG_B - p_WO;
    const Matrix3d P = Hat(p_OG);
    auto& I = tick->I_[b];
    I.topLeftCorner<3, 3>() =
        X_WB.R * M_B.I_G_B * X_WB.R.transpose() - M_B.mass * P * P;
    I.topRightCorner<3, 3>() = M_B.mass * P;
    I.bottomLeftCorner<3, 3>() = -M_B.mass * P;
    I.bottomRightCorner<3, 3>() = M_B.mass * Matrix3d::Identity();
    tick->F_[b] = I * tick->A_[b] + CrossMomentum(tick->V_[b], I * tick->V_[b]);
  }

  const Vector3d g_W = tree.gravity_W();
  Eigen::Matrix<double, 6, Eigen::Dynamic>& H = tick->H_G;  // About O first.
  for (int j = n - 1; j >= 0; --j) {
    const Vector6d S = tick->S_.col(j);
    const Vector6d F = tick->I_[j + 1] * S;
    H.col(v0 + j) = F;
    tick->c[v0 + j] = S.dot(tick->F_[j + 1]);
    for (int k = j; k >= 0; k = tree.joints()[k].parent - 1) {
      const double entry = tick->S_.col(k).dot(F);
      tick->M(v0 + k, v0 + j) = entry;
      tick->M(v0 + j, v0 + k) = entry;
    }
    tick->M(v0 + j, v0 + j) += tree.joints()[j].armature;
    const int parent = tree.joints()[j].parent;
    tick->I_[parent] += tick->I_[j + 1];
    tick->F_[parent] += tick->F_[j + 1];
  }

  const auto& I_O = tick->I_[0];
  if (tree.is_floating()) {
    H.leftCols<6>() = I_O.selfadjointView<Eigen::Upper>();
    tick->c.head<6>() = tick->F_[0];
    tick->M.topRows<6>() = H;
    tick->M.leftCols<6>() = H.transpose();
  }
  tick->N = tick->c;
  tick->N.noalias() -= H.bottomRows<3>().transpose() * g_W;

  // Equations (16)-(19), from O to G.
  const double mass = tree.total_mass();
  const Vector3d p_OG = mass > 0
                            ? Vector3d(Vee(I_O.topRightCorner<3, 3>()) / mass)
                            : Vector3d(Vector3d::Zero());
  H.topRows<3>().noalias() -= Hat(p_OG) * H.bottomRows<3>();
  tick->H_G_bias = tick->F_[0];
  tick->H_G_bias.head<3>() -= p_OG.cross(Vector3d(tick->F_[0].tail<3>()));
  tick->L_G.noalias() = H * v;
  tick->p_WG = p_WO + p_OG;
  tick->v_WG = mass > 0 ? Vector3d(tick->L_G.tail<3>() / mass)
                        : Vector3d(Vector3d::Zero());

  for (FrameTick& frame : tick->frames) {
    const Frame& F = tree.frames()[frame.frame];
    frame.X_WF = tick->X_WB[F.body] * F.X_BF;
    const Vector3d p_OF = frame.X_WF.p - p_WO;
    const auto shift = [&p_OF](const Vector6d& V) {
      return Stack(V.head<3>(), V.tail<3>() + V.head<3>().cross(p_OF));
    };
    frame.V_WF_W = shift(tick->V_[F.body]);
    frame.Jdot_v = shift(tick->A_[F.body]);
    frame.Jdot_v.tail<3>() +=
        frame.V_WF_W.head<3>().cross(frame.V_WF_W.tail<3>());
    for (int k = F.body - 1; k >= 0; k = tree.joints()[k].parent - 1) {
      frame.J_WF_W.col(v0 + k) = shift(tick->S_.col(k));
    }
    if (tree.is_floating()) {
      frame.J_WF_W.leftCols<6>().setIdentity();
      frame.J_WF_W.block<3, 3>(3, 0) = -Hat(p_OF);
    }
  }
}

}  // namespace poise
