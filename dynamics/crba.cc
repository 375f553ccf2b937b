// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/crba.h"

#include <cassert>

#include "poise/dynamics/simd/sweeps.h"
#include "poise/math/so3.h"
#include "poise/math/target_clones.h"

namespace poise {

POISE_TARGET_CLONES("avx2")
void FillMassMatrix(const Tree& tree, const Recursion& r,
                    Eigen::Ref<Eigen::MatrixXd> M) noexcept {
  assert(M.rows() == tree.nv() && M.cols() == tree.nv());
  const JointMaps& joints = tree.joint_maps();
  const int num_bodies = tree.num_bodies();
  const int v0 = tree.v_start();

  // Rows and columns 0-5 are the momentum [n; f] about the base's origin O at
  // unit rate. With m, h and Sigma of the whole robot,
  //     M_ll = [ trace(Sigma) 1 - Sigma   [h]x ],   column j: H_j about O.
  //            [         -[h]x            m 1  ]
  if (tree.is_floating()) {
    const MassMoments M_O = r.M_W[0];
    const Eigen::Matrix3d Sigma = ToEigen(M_O.Sigma);
    M.topLeftCorner<3, 3>() =
        Sigma.trace() * Eigen::Matrix3d::Identity() - Sigma;
    M.block<3, 3>(0, 3) = Hat(ToEigen(M_O.h));
    M.block<3, 3>(3, 0) = -Hat(ToEigen(M_O.h));
    M.block<3, 3>(3, 3) = M_O.mass * Eigen::Matrix3d::Identity();
    double* n_x = M.col(0).data() + v0 - 1;
    double* n_y = M.col(1).data() + v0 - 1;
    double* n_z = M.col(2).data() + v0 - 1;
    double* f_x = M.col(3).data() + v0 - 1;
    double* f_y = M.col(4).data() + v0 - 1;
    double* f_z = M.col(5).data() + v0 - 1;
    // H_O = [n + p_Oj x f; f].
    POISE_LANES
    for (int b = 1; b < num_bodies; ++b) {
      const Force3 H_O = Shift(r.p_OB_W[b], r.H_W[b]);
      n_x[b] = H_O.angular.x;
      n_y[b] = H_O.angular.y;
      n_z[b] = H_O.angular.z;
      f_x[b] = H_O.linear.x;
      f_y[b] = H_O.linear.y;
      f_z[b] = H_O.linear.z;
    }
    M.topRightCorner(6, num_bodies - 1) =
        M.bottomLeftCorner(num_bodies - 1, 6).transpose();
  }

  // M_jk = [turn_k; v]' H_j for each body j in the subtree of k, where v =
  // slide_k + turn_k x p_kj is the velocity of j's origin at unit rate of joint
  // k.
  for (int k = 1; k < num_bodies; ++k) {
    const Vec3 turn_W = r.turn_W[k], slide_W = r.slide_W[k];
    const Vec3 p_OK_W = r.p_OB_W[k];
    const int end = joints.end[k];
    double* M_k = M.col(v0 + k - 1).data() + v0 - 1;
    POISE_LANES
    for (int b = k; b < end; ++b) {
      const Force3 H = r.H_W[b];
      const Vec3 v_W = slide_W + Cross(turn_W, r.p_OB_W[b] - p_OK_W);
      M_k[b] = Dot(Motion3{turn_W, v_W}, H);
    }
    for (int b = k + 1; b < end; ++b) M(v0 + k - 1, v0 + b - 1) = M_k[b];
    M_k[k] += joints.armature[k];
  }
}

void ComputeCrba(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 Recursion* scratch, Eigen::Ref<Eigen::MatrixXd> M) noexcept {
  SweepPoses(tree, q, scratch);
  SweepInertias(tree, scratch);
  SumInertias(tree, scratch);
  SweepMomenta(tree, scratch);
  M.setZero();
  FillMassMatrix(tree, *scratch, M);
}

}  // namespace poise
