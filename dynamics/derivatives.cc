// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/derivatives.h"

#include <algorithm>
#include <cassert>

#include "poise/dynamics/crba.h"
#include "poise/dynamics/simd/sweeps.h"

namespace poise {

namespace {

using Moments = RneaDerivatives::Moments;

// Returns the rate of a motion y that is fixed in a body with velocity V: V x
// y.
Motion3 Cross(const Motion3& V, const Motion3& y) {
  return {Cross(V.angular, y.angular),
          Cross(V.angular, y.linear) + Cross(V.linear, y.angular)};
}

// Returns the rate of a force y that is fixed in a body with velocity V: V x*
// y.
Force3 Cross(const Motion3& V, const Force3& y) {
  return {Cross(V.angular, y.angular) + Cross(V.linear, y.linear),
          Cross(V.angular, y.linear)};
}

// Returns the matrix a b'.
Mat3 Outer(const Vec3& a, const Vec3& b) { return {a.x * b, a.y * b, a.z * b}; }

double Trace(const Mat3& A) { return A.x.x + A.y.y + A.z.z; }

// Returns the moments about P, from those about B.
Moments Shift(const Vec3& p_PB, const Moments& M) {
  return {M.n, M.f, M.fp + Outer(M.f, p_PB)};
}

Moments operator+(const Moments& M, const Moments& N) {
  return {M.n + N.n, M.f + N.f, M.fp + N.fp};
}

// Returns the change of the total force when each force turns by x about its
// own point:
//     [sum of x x n + p x (x x f); sum of x x f].
Force3 Turn(const Moments& M, const Vec3& x) {
  return {Cross(x, M.n) + Trace(M.fp) * x - M.fp * x, Cross(x, M.f)};
}

// Returns y, where y'x is the power of Turn(M, x) along a motion S about the
// same point.
Vec3 PowerOfTurn(const Moments& M, const Motion3& S) {
  const Vec3& t = S.angular;
  return Cross(M.n, t) + Trace(M.fp) * t - RowTimes(t, M.fp) +
         Cross(M.f, S.linear);
}

// Computes S, V, A and each body's own part of `coriolis`. An element dm at x
// from the body's origin has the momentum u dm, u = v_B + w x x. If the body
// turns by r faster, the Coriolis force on the element is 2 r x u dm.
void SweepMotions(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& v,
                  RneaDerivatives* out) {
  const JointMaps& joints = tree.joint_maps();
  const Recursion& r = out->recursion;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Vec3 p_OB = r.p_OB_W[b], w = r.w_WB[b], alpha = r.alpha_WB[b];
    Motion3 V{w, {0, 0, 0}};
    if (b > 0) {
      const Vec3 turn = r.turn_W[b];
      out->S[b] = {turn, r.slide_W[b] + Cross(p_OB, turn)};
      V.linear = out->V[joints.parent[b]].linear +
                 v[tree.v_start() + b - 1] * out->S[b].linear;
    }
    out->V[b] = V;
    // The spatial acceleration at O is the classical one of the body's point at
    // O, less w x v.
    out->A[b] = {alpha, r.a_WB[b] - AccelerationGradient(alpha, w) * p_OB -
                            Cross(w, V.linear)};
    const MassMoments M = r.M_W[b];
    const Vec3 v_B = V.linear + Cross(w, p_OB);
    const Mat3 S = Full(M.Sigma);
    const Mat3 w_x_S = {w.y * S.z - w.z * S.y, w.z * S.x - w.x * S.z,
                        w.x * S.y - w.y * S.x};
    out->coriolis[b] = {{0, 0, 0},
                        2 * (M.mass * v_B + Cross(w, M.h)),
                        2 * (Outer(v_B, M.h) + w_x_S)};
  }
}

void SumMoments(const Tree& tree, const Recursion& r,
                std::vector<Moments>* moments) {
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    Moments& M_P = (*moments)[tree.joint_maps().parent[b]];
    M_P = M_P + Shift(r.p_PB_W[b], (*moments)[b]);
  }
}

// Step 1 runs RNEA and sums, for the subtree of each body, M_W, F_W, H_W and
// the moments `coriolis` and `outside`:
//     F_b = sum of (I A - F from outside),   H_b = I_b S_b about O,
//     S_coriolis_b' x = S_b' Turn(coriolis_b, x),   S_outside likewise.
void SumSubtrees(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 const Eigen::Ref<const Eigen::VectorXd>& vdot,
                 const std::vector<SpatialForce>& F_Bo_W,
                 RneaDerivatives* out) {
  const int num_bodies = tree.num_bodies();
  const bool has_outside = !F_Bo_W.empty();
  Recursion& r = out->recursion;
  SweepPoses(tree, q, &r);
  SweepAccelerations(tree, v, vdot, tree.gravity_W(), &r);
  SweepInertias(tree, &r);
  SweepForces(tree, &r);
  SweepMotions(tree, v, out);
  if (has_outside) {
    for (int b = 0; b < num_bodies; ++b) {
      const Force3 F = ToForce3(F_Bo_W[b]);
      r.F_W.Set(b, r.F_W[b] - F);
      out->outside[b] = {F.angular, F.linear, {}};
    }
    SumMoments(tree, r, &out->outside);
  }
  SumMoments(tree, r, &out->coriolis);
  SumInertias(tree, &r);
  SumForces(tree, &r);
  SweepMomenta(tree, &r);
  for (int b = 1; b < num_bodies; ++b) {
    const Motion3 S_Bo{r.turn_W[b], r.slide_W[b]};
    out->H.Set(b, Shift(r.p_OB_W[b], r.H_W[b]));
    out->S_coriolis.Set(b, PowerOfTurn(out->coriolis[b], S_Bo));
    if (has_outside) out->S_outside.Set(b, PowerOfTurn(out->outside[b], S_Bo));
  }
}

// Variation describes how one entry of q or v varies the motion of a subtree.
// The velocity changes by `rate` and the acceleration by `rate_2`. A variation
// of q also carries the subtree along S.
struct Variation {
  const Motion3& S;
  const Motion3& rate;
  const Motion3& rate_2;
  bool is_carried;
};

// Step 2 fills column k of a derivative. A variation of the motion of `body`
// and its subtree changes the force on the subtree of a body b by
//     dF_b = S x* F_b + I_b rate_2 + Turn(coriolis_b, angular part of rate)
//            + Turn(outside_b, angular part of S).
// The last term is there because forces from outside keep their directions: the
// first term turns them with the subtree, the last one turns them back. The
// linear part of `rate` is uniform, and no force depends on a uniform velocity.
//     dtau_b = S_b' dF_body    for b = body and the joints up to the base,
//     dtau_b = rate_2' H_b + (angular part of rate)' S_coriolis_b
//              + (angular part of S)' S_outside_b    for b in its subtree.
// A joint in the subtree is carried along S too, so that S x* F_b has no
// effect.
void FillColumn(const Tree& tree, const RneaDerivatives& out, bool has_outside,
                int k, int body, const Variation& variation,
                Eigen::MatrixXd* matrix) {
  const auto& [S, rate, rate_2, is_carried] = variation;
  const JointMaps& joints = tree.joint_maps();
  const Recursion& r = out.recursion;
  const int row_0 = tree.v_start() - 1;
  double* column = matrix->col(k).data();
  const int end = joints.end[body];
  POISE_LANES
  for (int b = body + 1; b < end; ++b) {
    column[row_0 + b] =
        Dot(rate_2, out.H[b]) + Dot(rate.angular, out.S_coriolis[b]);
  }
  const Vec3 p_OB = r.p_OB_W[body];
  Force3 dF = Shift(p_OB, Turn(out.coriolis[body], rate.angular)) +
              Momentum(Shift(p_OB, r.M_W[body]), rate_2.angular, rate_2.linear);
  if (is_carried) {
    dF = dF + Cross(S, Shift(p_OB, r.F_W[body]));
    if (has_outside) {
      POISE_LANES
      for (int b = body + 1; b < end; ++b) {
        column[row_0 + b] += Dot(S.angular, out.S_outside[b]);
      }
      dF = dF + Shift(p_OB, Turn(out.outside[body], S.angular));
    }
  }
  for (int b = body; b > 0; b = joints.parent[b]) {
    column[row_0 + b] = Dot(out.S[b], dF);
  }
  if (tree.is_floating()) {
    matrix->col(k).head<6>() << ToEigen(dF.angular), ToEigen(dF.linear);
  }
}

}  // namespace

RneaDerivatives::RneaDerivatives(const Tree& tree)
    : dtau_dq(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      dtau_dv(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      dtau_dvdot(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      recursion(tree),
      S(tree.num_bodies()),
      V(tree.num_bodies()),
      A(tree.num_bodies()),
      coriolis(tree.num_bodies()),
      outside(tree.num_bodies()),
      H(tree.num_bodies()),
      S_coriolis(tree.num_bodies()),
      S_outside(tree.num_bodies()) {}

void ComputeRneaDerivatives(const Tree& tree,
                            const Eigen::Ref<const Eigen::VectorXd>& q,
                            const Eigen::Ref<const Eigen::VectorXd>& v,
                            const Eigen::Ref<const Eigen::VectorXd>& vdot,
                            const std::vector<SpatialForce>& F_Bo_W,
                            RneaDerivatives* out) noexcept {
  assert(F_Bo_W.empty() ||
         static_cast<int>(F_Bo_W.size()) == tree.num_bodies());
  const JointMaps& joints = tree.joint_maps();
  const bool has_outside = !F_Bo_W.empty();
  SumSubtrees(tree, q, v, vdot, F_Bo_W, out);

  // Step 3 varies each entry of q and v that the forces depend on. With S, V, A
  // of the base, or S of a joint and V, A of its parent,
  //     by q:   rate = V x S,   rate_2 = A x S + V x (V x S),   carried;
  //     by v:   rate = S,       rate_2 = V x S of the base, 2 V x S of a joint.
  if (tree.is_floating()) {
    const Motion3 axes[] = {{{1, 0, 0}, {}}, {{0, 1, 0}, {}}, {{0, 0, 1}, {}}};
    for (int k = 0; k < 3; ++k) {
      const Motion3& S = axes[k];
      const Motion3 rate = Cross(out->V[0], S);
      const Motion3 rate_2 = Cross(out->A[0], S) + Cross(out->V[0], rate);
      FillColumn(tree, *out, has_outside, k, 0, {S, rate, rate_2, true},
                 &out->dtau_dq);
      FillColumn(tree, *out, has_outside, k, 0, {{}, S, rate, false},
                 &out->dtau_dv);
    }
  }
  const int row_0 = tree.v_start() - 1;
  for (int b = 1; b < tree.num_bodies(); ++b) {
    const Motion3& S = out->S[b];
    const Motion3& V_P = out->V[joints.parent[b]];
    const Motion3 rate = Cross(V_P, S);
    const Motion3 rate_2 =
        Cross(out->A[joints.parent[b]], S) + Cross(V_P, rate);
    FillColumn(tree, *out, has_outside, row_0 + b, b, {S, rate, rate_2, true},
               &out->dtau_dq);
    FillColumn(tree, *out, has_outside, row_0 + b, b,
               {{}, S, rate + rate, false}, &out->dtau_dv);
  }
  FillMassMatrix(tree, out->recursion, out->dtau_dvdot);
}

}  // namespace poise
