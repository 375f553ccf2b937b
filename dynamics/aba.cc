// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/aba.h"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>
#include <limits>

#include "poise/dynamics/simd/sweeps.h"

namespace poise {
namespace {

// An inertia below this fraction of the inertia with locked joints is rounding.
constexpr double kRounding = 1e-13;

Vec3 TransposeTimes(const Mat3& A, const Vec3& v) { return RowTimes(v, A); }

Mat3 Transpose(const Mat3& A) {
  return {{A.x.x, A.y.x, A.z.x}, {A.x.y, A.y.y, A.z.y}, {A.x.z, A.y.z, A.z.z}};
}

// Returns [d]x A.
Mat3 CrossTimes(const Vec3& d, const Mat3& A) {
  return {d.y * A.z + -d.z * A.y, d.z * A.x + -d.x * A.z,
          d.x * A.y + -d.y * A.x};
}

// Returns the upper triangle of a matrix that is symmetric up to rounding.
Sym3 Symmetric(const Mat3& A) {
  return {A.x.x, A.y.y, A.z.z, A.x.y, A.x.z, A.y.z};
}

// Square() returns a a' / D, and Outer() returns a b' / D.
Sym3 Square(const Vec3& a, double D) {
  return {a.x * a.x / D, a.y * a.y / D, a.z * a.z / D,
          a.x * a.y / D, a.x * a.z / D, a.y * a.z / D};
}

Mat3 Outer(const Vec3& a, const Vec3& b, double D) {
  return {(a.x / D) * b, (a.y / D) * b, (a.z / D) * b};
}

Sym3 operator-(const Sym3& S, const Sym3& T) {
  return {S.xx - T.xx, S.yy - T.yy, S.zz - T.zz,
          S.xy - T.xy, S.xz - T.xz, S.yz - T.yz};
}

Mat3 operator-(const Mat3& A, const Mat3& B) {
  return {A.x - B.x, A.y - B.y, A.z - B.z};
}

using Body = AbaScratch::Body;

// Returns the force [J H; H' M] A.
Force3 operator*(const Body& body, const Motion3& A) {
  return {body.J * A.angular + body.H * A.linear,
          TransposeTimes(body.H, A.angular) + body.M * A.linear};
}

// Returns the articulated-body inertia of a single body:
//     J = trace(Sigma) 1 - Sigma,   H = [h]x,   M = m 1.
Body MakeBody(const MassMoments& M, const Force3& bias) {
  const double trace = M.Sigma.xx + M.Sigma.yy + M.Sigma.zz;
  const Vec3& h = M.h;
  return {{trace - M.Sigma.xx, trace - M.Sigma.yy, trace - M.Sigma.zz,
           -M.Sigma.xy, -M.Sigma.xz, -M.Sigma.yz},
          {{0, -h.z, h.y}, {h.z, 0, -h.x}, {-h.y, h.x, 0}},
          {M.mass, M.mass, M.mass, 0, 0, 0},
          bias};
}

// Adds the articulated-body inertia of a body B to that of its parent P. With
// d = p_PB, a_B = a_P - [d]x alpha and n_P = n_B + [d]x f_B,
//     H_P = H + [d]x M,   J_P = J - H [d]x + [d]x H_P'.
void AddShifted(const Body& B, const Vec3& d, Body* P) {
  const Mat3 H_P = B.H + CrossTimes(d, Full(B.M));
  const Mat3 minus_H_d = Transpose(CrossTimes(d, Transpose(B.H)));
  P->J = P->J + B.J + Symmetric(minus_H_d + CrossTimes(d, Transpose(H_P)));
  P->H = P->H + H_P;
  P->M = P->M + B.M;
  P->bias = P->bias + Shift(d, B.bias);
}

// Solves [J H; H' M] A = F for the acceleration A of a floating base. The
// matrix is scaled to unit diagonal by the locked robot's inertia, so that kg
// m2 and kg are comparable.
AbaStatus SolveBase(const Body& base, const MassMoments& M_locked,
                    const Force3& push, Vector6d* A) {
  const Body locked = MakeBody(M_locked, base.bias);
  Matrix6d I;
  I << ToEigen(base.J), ToEigen(base.H), ToEigen(base.H).transpose(),
      ToEigen(base.M);
  Vector6d diagonal;
  diagonal << locked.J.xx, locked.J.yy, locked.J.zz, locked.M.xx, locked.M.yy,
      locked.M.zz;
  if (!I.allFinite() || !diagonal.allFinite()) return AbaStatus::kNotFinite;
  if (!(diagonal.minCoeff() > 0)) return AbaStatus::kSingular;
  const Vector6d scale = diagonal.cwiseSqrt().cwiseInverse();
  I = scale.asDiagonal() * I * scale.asDiagonal();
  const Eigen::LDLT<Matrix6d> ldlt(I);
  if (!(ldlt.vectorD().minCoeff() > kRounding)) return AbaStatus::kSingular;
  Vector6d F;
  F << ToEigen(push.angular), ToEigen(push.linear);
  *A = scale.cwiseProduct(ldlt.solve(scale.cwiseProduct(F)));
  return AbaStatus::kOk;
}

bool AreFinite(const Eigen::Ref<const Eigen::VectorXd>& q,
               const Eigen::Ref<const Eigen::VectorXd>& v,
               const Eigen::Ref<const Eigen::VectorXd>& tau,
               const std::vector<SpatialForce>& F_Bo_W) {
  bool is_finite = q.allFinite() && v.allFinite() && tau.allFinite();
  for (const SpatialForce& F : F_Bo_W) {
    is_finite = is_finite && F.vector().allFinite();
  }
  return is_finite;
}

// The bias acceleration c_b of body b, a motion with all joints held at their
// rates, relative to its parent:
//     c = [ v_j (w_P x turn); w_P x (w_P x p_PB + 2 v_j slide) ].
inline Motion3 BiasAcceleration(const Recursion& r, double v_j, int b) {
  const Vec3 w_WP = r.w_WP[b], p_PB_W = r.p_PB_W[b];
  return {v_j * Cross(w_WP, r.turn_W[b]),
          Cross(w_WP, Cross(w_WP, p_PB_W) + 2 * v_j * r.slide_W[b])};
}

// Step 1 computes the inertia I_b and the bias force p_b of each body alone.
// p_b is the force that the body needs to turn with w, less the external force
// F_b:
//     p_b = [ sum of x x (w x (w x x)) dm; sum of w x (w x x) dm ] - F_b.
// r.M_W becomes the mass moments of the locked subtrees, for the test in step
// 2.
void MakeBodies(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& v,
                const std::vector<SpatialForce>& F_Bo_W, AbaScratch* scratch) {
  Recursion& r = scratch->recursion;
  SweepInertias(tree, &r);
  SweepAccelerations(tree, v, r.zero, Eigen::Vector3d::Zero(), &r);
  for (int b = 0; b < tree.num_bodies(); ++b) {
    Force3 bias = Accelerate(
        r.M_W[b], AccelerationGradient({0, 0, 0}, r.w_WB[b]), {0, 0, 0});
    if (!F_Bo_W.empty()) bias = bias - ToForce3(F_Bo_W[b]);
    scratch->bodies[b] = MakeBody(r.M_W[b], bias);
  }
  SumInertias(tree, &r);
}

// Step 2 eliminates the joints from the leaves to the base. With I_b and p_b
// the articulated inertia and bias force of the subtree of body b, its joints
// free,
//     U = I_b S,   D = S' U + armature,   u = tau_j - S' p_b,
//     I_b - U U' / D                      and
//     p_b + (I_b - U U' / D) c + U u / D
// are added to I and p of the parent, about its origin. Returns kSingular if a
// joint has no inertia: D is rounding beside the D of the locked subtree.
AbaStatus EliminateJoints(const Tree& tree,
                          const Eigen::Ref<const Eigen::VectorXd>& v,
                          const Eigen::Ref<const Eigen::VectorXd>& tau,
                          AbaScratch* scratch) {
  const JointMaps& joints = tree.joint_maps();
  const int v0 = tree.v_start();
  const Recursion& r = scratch->recursion;
  std::vector<Body>& bodies = scratch->bodies;
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    const Motion3 S{r.turn_W[b], r.slide_W[b]};
    Body& body = bodies[b];
    const Force3 U = body * S;
    const double D = Dot(S, U) + joints.armature[b];
    const double locked =
        Dot(S, Momentum(r.M_W[b], S.angular, S.linear)) + joints.armature[b];
    if (!(D > kRounding * locked)) {
      const bool is_finite = std::isfinite(D) && std::isfinite(locked);
      return is_finite ? AbaStatus::kSingular : AbaStatus::kNotFinite;
    }
    const double u = tau[v0 + b - 1] - Dot(S, body.bias);
    scratch->U[b] = U;
    scratch->D[b] = D;
    scratch->u[b] = u;

    body.J = body.J - Square(U.angular, D);
    body.H = body.H - Outer(U.angular, U.linear, D);
    body.M = body.M - Square(U.linear, D);
    body.bias = body.bias + body * BiasAcceleration(r, v[v0 + b - 1], b) +
                Force3{(u / D) * U.angular, (u / D) * U.linear};
    AddShifted(body, r.p_PB_W[b], &bodies[joints.parent[b]]);
  }
  return AbaStatus::kOk;
}

// Step 3 computes the acceleration of the base less gravity, into body 0 of the
// recursion. A base at rest has A_0 = [0; -g].
//     A_0 = I_0^-1 ([n; f] of tau - p_0),   v̇_0 = A_0 + [0; g]   if it floats.
AbaStatus ComputeBaseAcceleration(const Tree& tree,
                                  const Eigen::Ref<const Eigen::VectorXd>& tau,
                                  AbaScratch* scratch,
                                  Eigen::Ref<Eigen::VectorXd> vdot) {
  Recursion& r = scratch->recursion;
  const Vec3 g_W = ToVec3(tree.gravity_W());
  Motion3 A_0{{0, 0, 0}, -1 * g_W};
  if (tree.is_floating()) {
    const Force3& bias = scratch->bodies[0].bias;
    const Force3 push{ToVec3(tau.head<3>()) - bias.angular,
                      ToVec3(tau.segment<3>(3)) - bias.linear};
    Vector6d A;
    const AbaStatus status = SolveBase(scratch->bodies[0], r.M_W[0], push, &A);
    if (status != AbaStatus::kOk) return status;
    A_0 = {ToVec3(A.head<3>()), ToVec3(A.tail<3>())};
    vdot.head<3>() = A.head<3>();
    vdot.segment<3>(3) = A.tail<3>() + tree.gravity_W();
  }
  r.alpha_WB.Set(0, A_0.angular);
  r.a_WB.Set(0, A_0.linear);
  return AbaStatus::kOk;
}

// Step 4 computes the accelerations of the joints from the base to the leaves,
//     A = (A_P, shifted) + c,   v̇_j = (u - A' U) / D,   A_B = A + S v̇_j.
void ComputeJointAccelerations(const Tree& tree,
                               const Eigen::Ref<const Eigen::VectorXd>& v,
                               AbaScratch* scratch,
                               Eigen::Ref<Eigen::VectorXd> vdot) {
  const JointMaps& joints = tree.joint_maps();
  const int v0 = tree.v_start();
  Recursion& r = scratch->recursion;
  for (int b = 1; b < tree.num_bodies(); ++b) {
    const int parent = joints.parent[b];
    const Vec3 alpha_WP = r.alpha_WB[parent];
    const Motion3 A =
        Motion3{alpha_WP, r.a_WB[parent] + Cross(alpha_WP, r.p_PB_W[b])} +
        BiasAcceleration(r, v[v0 + b - 1], b);
    const double vdot_j =
        (scratch->u[b] - Dot(A, scratch->U[b])) / scratch->D[b];
    vdot[v0 + b - 1] = vdot_j;
    r.alpha_WB.Set(b, A.angular + vdot_j * r.turn_W[b]);
    r.a_WB.Set(b, A.linear + vdot_j * r.slide_W[b]);
  }
}

}  // namespace

AbaScratch::AbaScratch(const Tree& tree)
    : recursion(tree),
      bodies(tree.num_bodies()),
      U(tree.num_bodies()),
      D(tree.num_bodies()),
      u(tree.num_bodies()) {}

AbaStatus ComputeAba(const Tree& tree,
                     const Eigen::Ref<const Eigen::VectorXd>& q,
                     const Eigen::Ref<const Eigen::VectorXd>& v,
                     const Eigen::Ref<const Eigen::VectorXd>& tau,
                     const std::vector<SpatialForce>& F_Bo_W,
                     AbaScratch* scratch,
                     Eigen::Ref<Eigen::VectorXd> vdot) noexcept {
  assert(tau.size() == tree.nv() && vdot.size() == tree.nv());
  assert(F_Bo_W.empty() ||
         static_cast<int>(F_Bo_W.size()) == tree.num_bodies());
  const auto fail = [&vdot](AbaStatus status) {
    vdot.setConstant(std::numeric_limits<double>::quiet_NaN());
    return status;
  };
  if (!AreFinite(q, v, tau, F_Bo_W)) return fail(AbaStatus::kNotFinite);
  const Recursion& r = scratch->recursion;
  SweepPoses(tree, q, &scratch->recursion);
  if (!std::isfinite(r.R_WB[0].x.x)) return fail(AbaStatus::kNotFinite);
  MakeBodies(tree, v, F_Bo_W, scratch);
  AbaStatus status = EliminateJoints(tree, v, tau, scratch);
  if (status != AbaStatus::kOk) return fail(status);
  status = ComputeBaseAcceleration(tree, tau, scratch, vdot);
  if (status != AbaStatus::kOk) return fail(status);
  ComputeJointAccelerations(tree, v, scratch, vdot);
  if (!vdot.allFinite()) return fail(AbaStatus::kNotFinite);
  return AbaStatus::kOk;
}

}  // namespace poise
