// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/simd/sweeps.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/dynamics/simd/sin_cos.h"
#include "poise/math/quaternion.h"
#include "poise/math/target_clones.h"

namespace poise {
namespace {

// Returns whether the previous iteration of a sequential loop computed the
// parent. Its result is then still in registers, and the loop need not wait for
// a store to be read again.
bool IsNext(int parent, int b) { return parent == b - 1; }

}  // namespace

POISE_TARGET_CLONES("avx2")
void SweepPoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                Recursion* recursion) noexcept {
  assert(q.size() == tree.nq());
  const JointMaps& joints = tree.joint_maps();
  const int num_bodies = tree.num_bodies();
  const double* q_joint = q.data() + tree.q_start();
  Recursion& r = *recursion;

  SinCos(q_joint, num_bodies - 1, r.sine.data() + 1, r.cosine.data() + 1);

  // R_PB = R_constant + R_sine sin q + R_cosine cos q, stored in R_WB for now.
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    r.R_WB.Set(b, joints.R_constant[b] + r.sine[b] * joints.R_sine[b] +
                      r.cosine[b] * joints.R_cosine[b]);
  }

  // R_WB = R_WP R_PB.
  Mat3 R_WB = ToMat3(Eigen::Matrix3d::Identity());
  if (tree.is_floating()) {
    R_WB = ToMat3(MatrixFromQuaternion(
        Normalize(Eigen::Quaterniond(q[6], q[3], q[4], q[5]))));
  }
  r.R_WB.Set(0, R_WB);
  for (int b = 1; b < num_bodies; ++b) {
    const int parent = joints.parent[b];
    if (!IsNext(parent, b)) R_WB = r.R_WB[parent];
    r.R_WP.Set(b, R_WB);
    R_WB = R_WB * r.R_WB[b];
    r.R_WB.Set(b, R_WB);
  }

  // turn_W = R_WP turn_P,   slide_W = R_WP slide_P,
  // p_PB_W = R_WP p_PF + q slide_W.
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    const Mat3 R_WP = r.R_WP[b];
    const Vec3 slide_W = R_WP * joints.slide_P[b];
    r.turn_W.Set(b, R_WP * joints.turn_P[b]);
    r.slide_W.Set(b, slide_W);
    r.p_PB_W.Set(b, R_WP * joints.p_PF[b] + q_joint[b - 1] * slide_W);
  }

  // p_OB = p_OP + p_PB.
  Vec3 p_OB_W{0, 0, 0};
  r.p_OB_W.Set(0, p_OB_W);
  for (int b = 1; b < num_bodies; ++b) {
    const int parent = joints.parent[b];
    if (!IsNext(parent, b)) p_OB_W = r.p_OB_W[parent];
    p_OB_W = p_OB_W + r.p_PB_W[b];
    r.p_OB_W.Set(b, p_OB_W);
  }
}

POISE_TARGET_CLONES("avx2")
void SweepAccelerations(const Tree& tree,
                        const Eigen::Ref<const Eigen::VectorXd>& v,
                        const Eigen::Ref<const Eigen::VectorXd>& vdot,
                        const Eigen::Vector3d& g_W,
                        Recursion* recursion) noexcept {
  assert(v.size() == tree.nv() && vdot.size() == tree.nv());
  const JointMaps& joints = tree.joint_maps();
  const int num_bodies = tree.num_bodies();
  const double* v_joint = v.data() + tree.v_start();
  const double* vdot_joint = vdot.data() + tree.v_start();
  Recursion& r = *recursion;

  // The base: w and alpha of v and v̇, a_WB = v̇ - g; all zero but -g if fixed.
  Vec3 w_WB{0, 0, 0};
  Vec3 alpha_WB{0, 0, 0};
  Vec3 a_WB = ToVec3(-g_W);
  if (tree.is_floating()) {
    w_WB = ToVec3(v.head<3>());
    alpha_WB = ToVec3(vdot.head<3>());
    a_WB = a_WB + ToVec3(vdot.segment<3>(3));
  }

  // w_WB = w_WP + turn v.
  r.w_WB.Set(0, w_WB);
  for (int b = 1; b < num_bodies; ++b) {
    const int parent = joints.parent[b];
    if (!IsNext(parent, b)) w_WB = r.w_WB[parent];
    r.w_WP.Set(b, w_WB);
    w_WB = w_WB + v_joint[b - 1] * r.turn_W[b];
    r.w_WB.Set(b, w_WB);
  }

  // alpha_WB = alpha_WP + w_WP x turn v + turn v̇. The loop with lanes computes
  // the last two terms, the sequential loop adds alpha_WP.
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    const Vec3 turn_W = r.turn_W[b];
    r.alpha_WB.Set(b, v_joint[b - 1] * Cross(r.w_WP[b], turn_W) +
                          vdot_joint[b - 1] * turn_W);
  }
  r.alpha_WB.Set(0, alpha_WB);
  for (int b = 1; b < num_bodies; ++b) {
    const int parent = joints.parent[b];
    if (!IsNext(parent, b)) alpha_WB = r.alpha_WB[parent];
    r.alpha_WP.Set(b, alpha_WB);
    alpha_WB = alpha_WB + r.alpha_WB[b];
    r.alpha_WB.Set(b, alpha_WB);
  }

  // a_WB = a_WP + alpha_WP x p + w_WP x (w_WP x p + 2 slide v) + slide v̇, with
  // p = p_PB. The loop with lanes computes all terms but a_WP.
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    const Vec3 w_WP = r.w_WP[b], p_PB_W = r.p_PB_W[b], slide_W = r.slide_W[b];
    r.a_WB.Set(
        b, Cross(r.alpha_WP[b], p_PB_W) +
               Cross(w_WP, Cross(w_WP, p_PB_W) + 2 * v_joint[b - 1] * slide_W) +
               vdot_joint[b - 1] * slide_W);
  }
  r.a_WB.Set(0, a_WB);
  for (int b = 1; b < num_bodies; ++b) {
    const int parent = joints.parent[b];
    if (!IsNext(parent, b)) a_WB = r.a_WB[parent];
    a_WB = a_WB + r.a_WB[b];
    r.a_WB.Set(b, a_WB);
  }
}

POISE_TARGET_CLONES("avx2")
void SweepInertias(const Tree& tree, Recursion* recursion) noexcept {
  const MassMomentsArray& M_B = tree.mass_moments();
  const int num_bodies = tree.num_bodies();
  Recursion& r = *recursion;
  // h_W = R_WB h_B,   Sigma_W = R_WB Sigma_B R_WB'.
  POISE_LANES
  for (int b = 0; b < num_bodies; ++b) {
    r.M_W.Set(b, Rotate(r.R_WB[b], M_B[b]));
  }
}

POISE_TARGET_CLONES("avx2")
void SweepForces(const Tree& tree, Recursion* recursion) noexcept {
  const int num_bodies = tree.num_bodies();
  Recursion& r = *recursion;
  // F = [h x a + vee(A Sigma - Sigma A'); m a + A h],   A = [alpha]x + [w]x
  // [w]x.
  POISE_LANES
  for (int b = 0; b < num_bodies; ++b) {
    r.F_W.Set(
        b, Accelerate(r.M_W[b], AccelerationGradient(r.alpha_WB[b], r.w_WB[b]),
                      r.a_WB[b]));
  }
}

POISE_TARGET_CLONES("avx2")
void SumInertias(const Tree& tree, Recursion* recursion) noexcept {
  const std::vector<int>& parent = tree.joint_maps().parent;
  MassMomentsArray& M_W = recursion->M_W;
  // M_P = M_P + (M_B shifted by p_PB), from the leaves to the base.
  MassMoments M = M_W[tree.num_bodies() - 1];
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    const MassMoments M_P = M_W[parent[b]] + Shift(recursion->p_PB_W[b], M);
    M_W.Set(parent[b], M_P);
    M = IsNext(parent[b], b) ? M_P : M_W[b - 1];
  }
}

POISE_TARGET_CLONES("avx2")
void SumForces(const Tree& tree, Recursion* recursion) noexcept {
  const std::vector<int>& parent = tree.joint_maps().parent;
  Force3Array& F_W = recursion->F_W;
  // F_P = F_P + [n_B + p_PB x f_B; f_B], from the leaves to the base.
  Force3 F = F_W[tree.num_bodies() - 1];
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    const Force3 F_P = F_W[parent[b]] + Shift(recursion->p_PB_W[b], F);
    F_W.Set(parent[b], F_P);
    F = IsNext(parent[b], b) ? F_P : F_W[b - 1];
  }
}

POISE_TARGET_CLONES("avx2")
void SweepMomenta(const Tree& tree, Recursion* recursion) noexcept {
  const int num_bodies = tree.num_bodies();
  Recursion& r = *recursion;
  // H = [I turn + h x slide; m slide - h x turn] of the subtree.
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    r.H_W.Set(b, Momentum(r.M_W[b], r.turn_W[b], r.slide_W[b]));
  }
}

POISE_TARGET_CLONES("avx2")
void ProjectForces(const Tree& tree, const Recursion& r,
                   Eigen::Ref<Eigen::VectorXd> tau) noexcept {
  assert(tau.size() == tree.nv());
  if (tree.is_floating()) {
    const Force3 F = r.F_W[0];
    tau.head<6>() << ToEigen(F.angular), ToEigen(F.linear);
  }
  const int num_bodies = tree.num_bodies();
  double* tau_joint = tau.data() + tree.v_start();
  // tau_j = turn . n + slide . f.
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    tau_joint[b - 1] = Dot(Motion3{r.turn_W[b], r.slide_W[b]}, r.F_W[b]);
  }
}

}  // namespace poise
