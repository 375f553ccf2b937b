// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/tick.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/dynamics/crba.h"
#include "poise/math/so3.h"

namespace poise {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

void Store(const Vec3& v, double* out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

}  // namespace

Tick::Tick(const Tree& tree, const std::vector<int>& frame_indices)
    : M(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      N(Eigen::VectorXd::Zero(tree.nv())),
      c(Eigen::VectorXd::Zero(tree.nv())),
      X_WB(tree.num_bodies()),
      H_G(6, tree.nv()),
      recursion_(tree) {
  for (const int frame : frame_indices) {
    frames.push_back({frame, Pose(), Vector6d::Zero(),
                      Eigen::MatrixXd::Zero(6, tree.nv()), Vector6d::Zero()});
  }
}

void ComputeTick(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 Tick* tick) noexcept {
  const int num_bodies = tree.num_bodies();
  const JointMaps& joints = tree.joint_maps();
  const int v0 = tree.v_start();
  Recursion& r = tick->recursion_;

  SweepPoses(tree, q, &r);
  SweepAccelerations(tree, v, r.zero, Vector3d::Zero(), &r);
  SweepInertias(tree, &r);
  SweepForces(tree, &r);
  SumInertias(tree, &r);
  SumForces(tree, &r);
  SweepMomenta(tree, &r);
  FillMassMatrix(tree, r, tick->M);
  ProjectForces(tree, r, tick->c);

  const Vec3 p_WO = tree.is_floating() ? ToVec3(q.head<3>()) : Vec3{0, 0, 0};
  for (int b = 0; b < num_bodies; ++b) {
    const Mat3 R = r.R_WB[b];
    double* R_out = tick->X_WB[b].R.data();
    Store({R.x.x, R.y.x, R.z.x}, R_out);
    Store({R.x.y, R.y.y, R.z.y}, R_out + 3);
    Store({R.x.z, R.y.z, R.z.z}, R_out + 6);
    Store(p_WO + r.p_OB_W[b], tick->X_WB[b].p.data());
  }

  // Equations (16)-(19), from the base's origin O to G.
  const MassMoments M_O = r.M_W[0];
  const Force3 F_O = r.F_W[0];
  const double mass = tree.total_mass();
  const Vec3 p_OG = mass > 0 ? (1 / mass) * M_O.h : Vec3{0, 0, 0};
  const Vec3 p_GO = -1 * p_OG;
  auto& H = tick->H_G;
  const Vec3 g = ToVec3(tree.gravity_W());
  Vec3 n{0, 0, 0}, f{0, 0, 0};
  if (tree.is_floating()) {
    H.leftCols<6>() = tick->M.topLeftCorner<6, 6>();
    H.topLeftCorner<3, 6>() += Hat(ToEigen(p_GO)) * H.bottomLeftCorner<3, 6>();
    Vector6d L = H.leftCols<6>() * v.head<6>();
    n = ToVec3(L.head<3>());
    f = ToVec3(L.tail<3>());
    const Force3 N_O = F_O - Force3{Cross(M_O.h, g), M_O.mass * g};
    Store(N_O.angular, tick->N.data());
    Store(N_O.linear, tick->N.data() + 3);
  }
  for (int b = 1; b < num_bodies; ++b) {
    const Force3 H_G = Shift(p_GO + r.p_OB_W[b], r.H_W[b]);
    const double rate = v[v0 + b - 1];
    n = n + rate * H_G.angular;
    f = f + rate * H_G.linear;
    Store(H_G.angular, &H(0, v0 + b - 1));
    Store(H_G.linear, &H(3, v0 + b - 1));
    tick->N[v0 + b - 1] = tick->c[v0 + b - 1] - Dot(H_G.linear, g);
  }
  Store(n, tick->L_G.data());
  Store(f, tick->L_G.data() + 3);
  Store(F_O.angular + Cross(p_GO, F_O.linear), tick->H_G_bias.data());
  Store(F_O.linear, tick->H_G_bias.data() + 3);
  Store(p_WO + p_OG, tick->p_WG.data());
  Store((mass > 0 ? 1 / mass : 0) * f, tick->v_WG.data());

  for (FrameTick& frame : tick->frames) {
    const Frame& F = tree.frames()[frame.frame];
    const int body = F.body;
    const Mat3 R_WB = r.R_WB[body];
    const Vec3 p_BF_W = R_WB * ToVec3(F.X_BF.p);
    frame.X_WF.R = ToEigen(R_WB) * F.X_BF.R;
    frame.X_WF.p = tick->X_WB[body].p + ToEigen(p_BF_W);
    const Vec3 alpha = r.alpha_WB[body];
    const Vec3 p_OF = p_BF_W + r.p_OB_W[body];
    Store(alpha, frame.Jdot_v.data());
    Store(r.a_WB[body] + AccelerationGradient(alpha, r.w_WB[body]) * p_BF_W,
          frame.Jdot_v.data() + 3);
    for (int k = body; k > 0; k = joints.parent[k]) {
      Store(r.turn_W[k], &frame.J_WF_W(0, v0 + k - 1));
      Store(r.slide_W[k] + Cross(r.turn_W[k], p_OF - r.p_OB_W[k]),
            &frame.J_WF_W(3, v0 + k - 1));
    }
    if (tree.is_floating()) {
      frame.J_WF_W.leftCols<6>().setIdentity();
      frame.J_WF_W.block<3, 3>(3, 0) = -Hat(ToEigen(p_OF));
    }
    frame.V_WF_W.noalias() = frame.J_WF_W * v;
  }
}

}  // namespace poise
