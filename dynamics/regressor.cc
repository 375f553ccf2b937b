// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/regressor.h"

#include <Eigen/Geometry>
#include <cassert>

#include "poise/dynamics/simd/sweeps.h"
#include "poise/math/so3.h"
#include "poise/math/vector6.h"

namespace poise {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr int kPerBody = 10;

// Returns the matrix of I w as a linear function of [Ixx; Iyy; Izz; Ixy; Ixz;
// Iyz].
Eigen::Matrix<double, 3, 6> InertiaTimes(const Vector3d& w) {
  Eigen::Matrix<double, 3, 6> result;
  result << w.x(), 0, 0, w.y(), w.z(), 0,  //
      0, w.y(), 0, w.x(), 0, w.z(),        //
      0, 0, w.z(), 0, w.x(), w.y();
  return result;
}

// Returns the matrix of the wrench on a body as a linear function of its ten
// inertial parameters, about the body's origin and in its axes:
//     n = h x a + I alpha + w x I w,   f = m a + ([alpha]x + [w]x [w]x) h.
Eigen::Matrix<double, 6, kPerBody> BodyRegressor(const Vector3d& w,
                                                 const Vector3d& alpha,
                                                 const Vector3d& a) {
  Eigen::Matrix<double, 6, kPerBody> Y;
  Y.topLeftCorner<3, 1>().setZero();
  Y.block<3, 3>(0, 1) = -Hat(a);
  Y.block<3, 6>(0, 4) = InertiaTimes(alpha) + Hat(w) * InertiaTimes(w);
  Y.block<3, 1>(3, 0) = a;
  Y.block<3, 3>(3, 1) = Hat(alpha) + Hat(w) * Hat(w);
  Y.block<3, 6>(3, 4).setZero();
  return Y;
}

}  // namespace

void ComputeRegressor(const Tree& tree,
                      const Eigen::Ref<const Eigen::VectorXd>& q,
                      const Eigen::Ref<const Eigen::VectorXd>& v,
                      const Eigen::Ref<const Eigen::VectorXd>& vdot,
                      Recursion* scratch,
                      Eigen::Ref<Eigen::MatrixXd> Y) noexcept {
  const JointMaps& joints = tree.joint_maps();
  const int num_bodies = tree.num_bodies();
  const int v0 = tree.v_start();
  assert(Y.rows() == tree.nv());
  assert(Y.cols() == kPerBody * num_bodies + tree.num_joints());
  const Recursion& r = *scratch;
  SweepPoses(tree, q, scratch);
  SweepAccelerations(tree, v, vdot, tree.gravity_W(), scratch);

  Y.setZero();
  for (int b = 0; b < num_bodies; ++b) {
    const Matrix3d R_WB = ToEigen(r.R_WB[b]);
    const Matrix3d R_BW = R_WB.transpose();
    Eigen::Matrix<double, 6, kPerBody> Y_B =
        BodyRegressor(R_BW * ToEigen(r.w_WB[b]), R_BW * ToEigen(r.alpha_WB[b]),
                      R_BW * ToEigen(r.a_WB[b]));
    Y_B.topRows<3>() = (R_WB * Y_B.topRows<3>()).eval();
    Y_B.bottomRows<3>() = (R_WB * Y_B.bottomRows<3>()).eval();

    // Row k is S_k' [n; f], for each joint k between the body and the base.
    auto columns = Y.middleCols<kPerBody>(kPerBody * b);
    const Vector3d p_OB_W = ToEigen(r.p_OB_W[b]);
    for (int k = b; k > 0; k = joints.parent[k]) {
      const Vector3d turn_W = ToEigen(r.turn_W[k]);
      const Vector3d v_W =
          ToEigen(r.slide_W[k]) + turn_W.cross(p_OB_W - ToEigen(r.p_OB_W[k]));
      columns.row(v0 + k - 1).noalias() =
          turn_W.transpose() * Y_B.topRows<3>() +
          v_W.transpose() * Y_B.bottomRows<3>();
    }
    if (tree.is_floating()) {
      columns.topRows<3>() =
          Y_B.topRows<3>() + Hat(p_OB_W) * Y_B.bottomRows<3>();
      columns.middleRows<3>(3) = Y_B.bottomRows<3>();
    }
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    Y(v0 + j, kPerBody * num_bodies + j) = vdot[v0 + j];
  }
}

Eigen::VectorXd MakeInertialParameters(const Tree& tree) {
  Eigen::VectorXd pi(kPerBody * tree.num_bodies() + tree.num_joints());
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Inertia& M_B = tree.inertias()[b];
    const Matrix3d P = Hat(M_B.p_BoG_B);
    const Matrix3d I = M_B.I_G_B - M_B.mass * P * P;
    pi.segment<kPerBody>(kPerBody * b) << M_B.mass, M_B.mass * M_B.p_BoG_B,
        I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2);
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    pi[kPerBody * tree.num_bodies() + j] = tree.joints()[j].armature;
  }
  return pi;
}

}  // namespace poise
