// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/tick.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/dynamics/crba.h"
#include "poise/dynamics/simd/sweeps.h"
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

// The position of the base's origin O; a fixed base stands at W's origin.
Vec3 BasePosition(const Tree& tree,
                  const Eigen::Ref<const Eigen::VectorXd>& q) {
  return tree.is_floating() ? ToVec3(q.head<3>()) : Vec3{0, 0, 0};
}

// Step 1 computes the equation of motion (7), M v̇ + N = S' tau + J_c' lambda.
// With S_j = [turn; slide] of joint j, and with sums over the subtree of j,
//     H_j  = I_j S_j              momentum at unit rate of joint j,
//     M_jk = S_k' H_j + armature  if j is in the subtree of k, and symmetric,
//     F_j  = sum of F_b           force on the bodies at v̇ = 0 and g = 0,
//     c_j  = S_j' F_j             Coriolis and centrifugal forces, (17),
//     N_j  = c_j - l_j' g,        l_j the linear part of H_j.
// The armature stands on the diagonal only. The rows of a floating base are
//     c = F_O,   N = F_O - [h x g; m g],   h = m p_OG.
// Source: Featherstone 2008, tables 5.1 (RNEA) and 6.2 (composite bodies).
void ComputeEquationOfMotion(const Tree& tree,
                             const Eigen::Ref<const Eigen::VectorXd>& q,
                             const Eigen::Ref<const Eigen::VectorXd>& v,
                             Recursion* recursion, Tick* tick) {
  Recursion& r = *recursion;
  SweepPoses(tree, q, &r);
  SweepAccelerations(tree, v, r.zero, Vector3d::Zero(), &r);
  SweepInertias(tree, &r);
  SweepForces(tree, &r);
  SumInertias(tree, &r);
  SumForces(tree, &r);
  SweepMomenta(tree, &r);
  FillMassMatrix(tree, r, tick->M);
  ProjectForces(tree, r, tick->c);

  const Vec3 g = ToVec3(tree.gravity_W());
  if (tree.is_floating()) {
    const MassMoments M_O = r.M_W[0];
    const Force3 N_O = r.F_W[0] - Force3{Cross(M_O.h, g), M_O.mass * g};
    Store(N_O.angular, tick->N.data());
    Store(N_O.linear, tick->N.data() + 3);
  }
  const int v0 = tree.v_start();
  for (int b = 1; b < tree.num_bodies(); ++b) {
    tick->N[v0 + b - 1] = tick->c[v0 + b - 1] - Dot(r.H_W[b].linear, g);
  }
}

// Step 2 stores the pose of each body, R_WB and p_WB = p_WO + p_OB.
void StoreBodyPoses(const Tree& tree,
                    const Eigen::Ref<const Eigen::VectorXd>& q,
                    const Recursion& r, Tick* tick) {
  const Vec3 p_WO = BasePosition(tree, q);
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Mat3 R = r.R_WB[b];
    double* R_out = tick->X_WB[b].R.data();
    Store({R.x.x, R.y.x, R.z.x}, R_out);
    Store({R.x.y, R.y.y, R.z.y}, R_out + 3);
    Store({R.x.z, R.y.z, R.z.z}, R_out + 6);
    Store(p_WO + r.p_OB_W[b], tick->X_WB[b].p.data());
  }
}

// Step 3 computes the centroidal momentum by (16)-(19), from the base's origin
// O to the center of mass G. The base's rates in v are V_WB_W, so Phi of (16)
// is the identity, and X of (18) shifts a force or momentum from O to G:
//     p_OG = h / m,   X = [ 1  [p_GO]x ],   H_G = X M_l,   bias = X c_l.
//                         [ 0     1    ]
// Column j of H_G is that of (19), computed from the subtree of joint j:
//     [n; f] = H_j   becomes   [n + p_Gj x f; f],
// where p_Gj leads from G to the origin of the body that joint j moves. Then
//     L_G = H_G v,   p_WG = p_WO + p_OG,   v_WG = (linear part of L_G) / m.
void ComputeCentroidalDynamics(const Tree& tree,
                               const Eigen::Ref<const Eigen::VectorXd>& q,
                               const Eigen::Ref<const Eigen::VectorXd>& v,
                               const Recursion& r, Tick* tick) {
  const MassMoments M_O = r.M_W[0];
  const Force3 F_O = r.F_W[0];
  const double mass = tree.total_mass();
  const Vec3 p_OG = mass > 0 ? (1 / mass) * M_O.h : Vec3{0, 0, 0};
  const Vec3 p_GO = -1 * p_OG;
  auto& H = tick->H_G;
  Vec3 n{0, 0, 0}, f{0, 0, 0};
  if (tree.is_floating()) {
    H.leftCols<6>() = tick->M.topLeftCorner<6, 6>();
    H.topLeftCorner<3, 6>() += Hat(ToEigen(p_GO)) * H.bottomLeftCorner<3, 6>();
    Vector6d L = H.leftCols<6>() * v.head<6>();
    n = ToVec3(L.head<3>());
    f = ToVec3(L.tail<3>());
  }
  const int v0 = tree.v_start();
  for (int b = 1; b < tree.num_bodies(); ++b) {
    const Force3 H_G = Shift(p_GO + r.p_OB_W[b], r.H_W[b]);
    const double rate = v[v0 + b - 1];
    n = n + rate * H_G.angular;
    f = f + rate * H_G.linear;
    Store(H_G.angular, &H(0, v0 + b - 1));
    Store(H_G.linear, &H(3, v0 + b - 1));
  }
  Store(n, tick->L_G.data());
  Store(f, tick->L_G.data() + 3);
  Store(F_O.angular + Cross(p_GO, F_O.linear), tick->H_G_bias.data());
  Store(F_O.linear, tick->H_G_bias.data() + 3);
  Store(BasePosition(tree, q) + p_OG, tick->p_WG.data());
  Store((mass > 0 ? 1 / mass : 0) * f, tick->v_WG.data());
}

// Step 4 computes the pose, Jacobian, bias and velocity of a frame F on body B,
// J_c and its bias in (11) if F is a foot in contact:
//     X_WF = X_WB X_BF,   V_WF = J_WF v,
//     J_WF = [turn_k; slide_k + turn_k x p_kF]  of joint k between O and B,
//            [1 0; -[p_OF]x 1]                  of a floating base,
//            0                                  of every other joint,
//     Jdot_v = [alpha; a_B + ([alpha]x + [w]x [w]x) p_BF]   at v̇ = 0.
void ComputeFrameTick(const Tree& tree,
                      const Eigen::Ref<const Eigen::VectorXd>& v,
                      const Recursion& r, const std::vector<Pose>& X_WB,
                      FrameTick* frame) {
  const JointMaps& joints = tree.joint_maps();
  const int v0 = tree.v_start();
  const Frame& F = tree.frames()[frame->frame];
  const int body = F.body;
  const Mat3 R_WB = r.R_WB[body];
  const Vec3 p_BF_W = R_WB * ToVec3(F.X_BF.p);
  frame->X_WF.R = ToEigen(R_WB) * F.X_BF.R;
  frame->X_WF.p = X_WB[body].p + ToEigen(p_BF_W);
  const Vec3 alpha = r.alpha_WB[body];
  const Vec3 p_OF = p_BF_W + r.p_OB_W[body];
  Store(alpha, frame->Jdot_v.data());
  Store(r.a_WB[body] + AccelerationGradient(alpha, r.w_WB[body]) * p_BF_W,
        frame->Jdot_v.data() + 3);
  for (int k = body; k > 0; k = joints.parent[k]) {
    Store(r.turn_W[k], &frame->J_WF_W(0, v0 + k - 1));
    Store(r.slide_W[k] + Cross(r.turn_W[k], p_OF - r.p_OB_W[k]),
          &frame->J_WF_W(3, v0 + k - 1));
  }
  if (tree.is_floating()) {
    frame->J_WF_W.leftCols<6>().setIdentity();
    frame->J_WF_W.block<3, 3>(3, 0) = -Hat(ToEigen(p_OF));
  }
  frame->V_WF_W.noalias() = frame->J_WF_W * v;
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
  Recursion& r = tick->recursion_;
  ComputeEquationOfMotion(tree, q, v, &r, tick);
  StoreBodyPoses(tree, q, r, tick);
  ComputeCentroidalDynamics(tree, q, v, r, tick);
  for (FrameTick& frame : tick->frames) {
    ComputeFrameTick(tree, v, r, tick->X_WB, &frame);
  }
}

}  // namespace poise
