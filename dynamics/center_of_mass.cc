// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/center_of_mass.h"

#include "poise/dynamics/simd/sweeps.h"
#include "poise/math/so3.h"

namespace poise {

void ComputeCenterOfMass(const Tree& tree,
                         const Eigen::Ref<const Eigen::VectorXd>& q,
                         const Eigen::Ref<const Eigen::VectorXd>& v,
                         Recursion* scratch, CenterOfMass* out) noexcept {
  Recursion& r = *scratch;
  SweepPoses(tree, q, &r);
  SweepAccelerations(tree, v, r.zero, Eigen::Vector3d::Zero(), &r);
  SweepInertias(tree, &r);
  SweepForces(tree, &r);
  SumInertias(tree, &r);
  SumForces(tree, &r);
  SweepMomenta(tree, &r);

  const double mass = tree.total_mass();
  const double per_mass = mass > 0 ? 1 / mass : 0;
  const Eigen::Vector3d p_BoG_W = per_mass * ToEigen(r.M_W[0].h);
  out->p_WG = p_BoG_W;
  if (tree.is_floating()) {
    out->p_WG += q.head<3>();
    out->J_WG.leftCols<3>() = -per_mass * mass * Hat(p_BoG_W);
    out->J_WG.middleCols<3>(3) = per_mass * mass * Eigen::Matrix3d::Identity();
  }
  for (int b = 1; b < tree.num_bodies(); ++b) {
    out->J_WG.col(tree.v_start() + b - 1) = per_mass * ToEigen(r.H_W[b].linear);
  }
  out->v_WG.noalias() = out->J_WG * v;
  out->bias = per_mass * ToEigen(r.F_W[0].linear);
}

}  // namespace poise
