// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "dynamics/derivatives.h"

#include <algorithm>
#include <cassert>

#include "dynamics/crba.h"
#include "math/so3.h"

namespace poise {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Vector6d Stack(const Vec3& angular, const Vec3& linear) {
  Vector6d result;
  result << ToEigen(angular), ToEigen(linear);
  return result;
}

// The matrix of V x: how a motion changes when V carries it along.
Matrix6d CrossMotion(const Vector6d& V) {
  return CrossMatrix({V.head<3>(), V.tail<3>()});
}

// The matrix of V x*: the same for a force or a momentum.
Matrix6d CrossForce(const Vector6d& V) { return -CrossMotion(V).transpose(); }

// The matrix of x -> x x* L.
Matrix6d CrossWith(const Vector6d& L) {
  const Matrix3d n = Hat(L.head<3>()), f = Hat(L.tail<3>());
  Matrix6d result;
  result << -n, -f, -f, Matrix3d::Zero();
  return result;
}

Matrix6d SpatialInertia(const MassMoments& M) {
  const Matrix3d Sigma = ToEigen(M.Sigma);
  const Matrix3d h = Hat(ToEigen(M.h));
  Matrix6d I;
  I << Sigma.trace() * Matrix3d::Identity() - Sigma, h, -h,
      M.mass * Matrix3d::Identity();
  return I;
}

}  // namespace

RneaDerivatives::RneaDerivatives(const Tree& tree)
    : dtau_dq(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      dtau_dv(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      dtau_dvdot(Eigen::MatrixXd::Zero(tree.nv(), tree.nv())),
      recursion(tree),
      I(tree.num_bodies()),
      B(tree.num_bodies()),
      F(tree.num_bodies()),
      E(tree.num_bodies()),
      V(tree.num_bodies()),
      A(tree.num_bodies()),
      S(tree.num_bodies()) {}

void ComputeRneaDerivatives(const Tree& tree,
                            const Eigen::Ref<const Eigen::VectorXd>& q,
                            const Eigen::Ref<const Eigen::VectorXd>& v,
                            const Eigen::Ref<const Eigen::VectorXd>& vdot,
                            const std::vector<SpatialForce>& F_Bo_W,
                            RneaDerivatives* out) noexcept {
  assert(F_Bo_W.empty() ||
         static_cast<int>(F_Bo_W.size()) == tree.num_bodies());
  const JointMaps& joints = tree.joint_maps();
  const int num_bodies = tree.num_bodies();
  const int v0 = tree.v_start();
  Recursion& r = out->recursion;
  SweepPoses(tree, q, &r);
  SweepInertias(tree, &r);
  SweepAccelerations(tree, v, vdot, tree.gravity_W(), &r);

  // Spatial quantities about one point, the base's origin O, which may be taken
  // at rest: a uniform motion changes no force. A spatial acceleration is the
  // classical one of the body's point at O, less w x v there.
  for (int b = 0; b < num_bodies; ++b) {
    const Vec3 p_BO = -1 * r.p_OB_W[b];
    const Vec3 w = r.w_WB[b], alpha = r.alpha_WB[b];
    if (b == 0) {
      out->V[0] = Stack(w, {0, 0, 0});
    } else {
      out->S[b] = Stack(r.turn_W[b], r.slide_W[b] + Cross(r.turn_W[b], p_BO));
      out->V[b] = out->V[joints.parent[b]] + v[v0 + b - 1] * out->S[b];
    }
    const Vec3 v_O = ToVec3(out->V[b].tail<3>());
    out->A[b] = Stack(alpha, r.a_WB[b] + AccelerationGradient(alpha, w) * p_BO -
                                 Cross(w, v_O));
    const Matrix6d I = SpatialInertia(Shift(r.p_OB_W[b], r.M_W[b]));
    const Vector6d L = I * out->V[b];
    out->I[b] = I;
    out->F[b] = I * out->A[b] + CrossForce(out->V[b]) * L;
    out->B[b] =
        CrossForce(out->V[b]) * I - I * CrossMotion(out->V[b]) + CrossWith(L);
    out->E[b].setZero();
    if (!F_Bo_W.empty()) {
      const Vector3d p_OB_W = ToEigen(r.p_OB_W[b]);
      const Matrix3d f = Hat(F_Bo_W[b].linear);
      out->F[b] -= Shift(F_Bo_W[b], -p_OB_W).vector();
      out->E[b] << -Hat(F_Bo_W[b].angular) - Hat(p_OB_W) * f, -f;
    }
  }
  for (int b = num_bodies - 1; b > 0; --b) {
    out->I[joints.parent[b]] += out->I[b];
    out->B[joints.parent[b]] += out->B[b];
    out->F[joints.parent[b]] += out->F[b];
    out->E[joints.parent[b]] += out->E[b];
  }

  // Column k: a variation of joint k by S_k carries its subtree along, and
  // changes velocities by rate and accelerations by rate_2 beyond that:
  //     dF_i = [S_k x* F_i] + I_i rate_2 + B_i rate + E_i turn,
  // where what is carried along counts for the joints below k alone. What acts
  // from outside keeps its direction: turned with the subtree at first, in F_i,
  // it is turned back by E_i about the bodies' origins, where it acts.
  const auto set = [&](int column, int body, const Vector6d& carried,
                       const Vector6d& rate, const Vector6d& rate_2,
                       const Vector3d& turn, Eigen::MatrixXd* matrix) {
    const auto change_of = [&](int b) -> Vector6d {
      return out->I[b] * rate_2 + out->B[b] * rate;
    };
    for (int b = body; b < joints.end[body]; ++b) {
      if (b > 0) (*matrix)(v0 + b - 1, column) = out->S[b].dot(change_of(b));
    }
    Vector6d dF = carried + change_of(body);
    if (!F_Bo_W.empty()) {
      for (int b = std::max(body, 1); b < joints.end[body]; ++b) {
        (*matrix)(v0 + b - 1, column) += out->S[b].dot(out->E[b] * turn);
      }
      dF += out->E[body] * turn;
    }
    for (int b = body; b > 0; b = joints.parent[b]) {
      (*matrix)(v0 + b - 1, column) = out->S[b].dot(dF);
    }
    if (tree.is_floating()) matrix->col(column).head<6>() = dF;
  };
  if (tree.is_floating()) {
    for (int k = 0; k < 3; ++k) {
      const Vector6d S = Vector6d::Unit(k);
      const Vector6d rate = CrossMotion(out->V[0]) * S;
      set(k, 0, CrossForce(S) * out->F[0], rate,
          CrossMotion(out->A[0]) * S + CrossMotion(out->V[0]) * rate,
          S.head<3>(), &out->dtau_dq);
      set(k, 0, Vector6d::Zero(), S, rate, Vector3d::Zero(), &out->dtau_dv);
    }
  }
  for (int b = 1; b < num_bodies; ++b) {
    const int k = v0 + b - 1;
    const Vector6d& S = out->S[b];
    const Matrix6d V_P = CrossMotion(out->V[joints.parent[b]]);
    const Vector6d rate = V_P * S;
    set(k, b, CrossForce(S) * out->F[b], rate,
        CrossMotion(out->A[joints.parent[b]]) * S + V_P * rate, S.head<3>(),
        &out->dtau_dq);
    set(k, b, Vector6d::Zero(), S, 2 * rate, Vector3d::Zero(), &out->dtau_dv);
  }

  SumInertias(tree, &r);
  SweepMomenta(tree, &r);
  FillMassMatrix(tree, r, out->dtau_dvdot);
}

}  // namespace poise
