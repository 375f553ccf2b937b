// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/centroidal.h"

#include <cassert>

#include "poise/dynamics/simd/sweeps.h"
#include "poise/math/so3.h"
#include "poise/math/target_clones.h"

namespace poise {
namespace {

// Returns p_GO; a tree without mass has its center of mass at O.
Vec3 BaseFromCenterOfMass(const Tree& tree, const Recursion& r) {
  const double mass = tree.total_mass();
  return (mass > 0 ? -1 / mass : 0) * r.M_W[0].h;
}

// Fills H_G from the composite inertia and the momenta of the subtrees.
POISE_TARGET_CLONES("avx2")
void FillMomentumMatrix(const Tree& tree, const Recursion& r, const Vec3& p_GO,
                        Matrix6Xd* H_G) {
  assert(H_G->cols() == tree.nv());
  const int num_bodies = tree.num_bodies();
  if (tree.is_floating()) {
    const MassMoments M_O = r.M_W[0];
    const Eigen::Matrix3d Sigma_G = ToEigen(Shift(p_GO, M_O).Sigma);
    H_G->topLeftCorner<3, 3>() =
        Sigma_G.trace() * Eigen::Matrix3d::Identity() - Sigma_G;
    H_G->block<3, 3>(0, 3).setZero();
    H_G->block<3, 3>(3, 0) = -Hat(ToEigen(M_O.h));
    H_G->block<3, 3>(3, 3) = M_O.mass * Eigen::Matrix3d::Identity();
  }
  const int before = tree.v_start() - 1;
  double* entries = H_G->data();
  POISE_LANES
  for (int b = 1; b < num_bodies; ++b) {
    const Force3 H_j = Shift(p_GO + r.p_OB_W[b], r.H_W[b]);
    const int column = 6 * (before + b);
    entries[column] = H_j.angular.x;
    entries[column + 1] = H_j.angular.y;
    entries[column + 2] = H_j.angular.z;
    entries[column + 3] = H_j.linear.x;
    entries[column + 4] = H_j.linear.y;
    entries[column + 5] = H_j.linear.z;
  }
}

}  // namespace

void ComputeCentroidalMomentumMatrix(const Tree& tree,
                                     const Eigen::Ref<const Eigen::VectorXd>& q,
                                     Recursion* scratch,
                                     Matrix6Xd* H_G) noexcept {
  Recursion& r = *scratch;
  SweepPoses(tree, q, &r);
  SweepInertias(tree, &r);
  SumInertias(tree, &r);
  SweepMomenta(tree, &r);
  FillMomentumMatrix(tree, r, BaseFromCenterOfMass(tree, r), H_G);
}

void ComputeCentroidalMomentum(const Tree& tree,
                               const Eigen::Ref<const Eigen::VectorXd>& q,
                               const Eigen::Ref<const Eigen::VectorXd>& v,
                               Recursion* scratch,
                               CentroidalMomentum* out) noexcept {
  Recursion& r = *scratch;
  SweepPoses(tree, q, &r);
  SweepAccelerations(tree, v, r.zero, Eigen::Vector3d::Zero(), &r);
  SweepInertias(tree, &r);
  SweepForces(tree, &r);
  SumInertias(tree, &r);
  SumForces(tree, &r);
  SweepMomenta(tree, &r);
  const Vec3 p_GO = BaseFromCenterOfMass(tree, r);
  FillMomentumMatrix(tree, r, p_GO, &out->H_G);
  const Force3 F_G = Shift(p_GO, r.F_W[0]);
  out->bias << ToEigen(F_G.angular), ToEigen(F_G.linear);
}

void ComputeCentroidalMomentum(const Eigen::Ref<const Eigen::MatrixXd>& M,
                               const Eigen::Ref<const Eigen::VectorXd>& c,
                               const Eigen::Vector3d& p_BoG_W,
                               CentroidalMomentum* out) noexcept {
  assert(M.cols() == out->H_G.cols() && M.rows() >= 6 && c.size() >= 6);
  out->H_G = M.topRows<6>();
  out->bias = c.head<6>();
  out->H_G.topRows<3>().noalias() -= Hat(p_BoG_W) * M.middleRows<3>(3);
  out->bias.head<3>().noalias() -= Hat(p_BoG_W) * c.segment<3>(3);
}

Inertia CompositeInertia(const Tree& tree,
                         const std::vector<Pose>& X_WB) noexcept {
  Inertia composite;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    composite = composite + X_WB[b] * tree.inertias()[b];
  }
  return composite;
}

}  // namespace poise
