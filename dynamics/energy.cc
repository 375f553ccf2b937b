// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/energy.h"

#include "poise/math/inertia.h"

namespace poise {

double KineticEnergy(const Tree& tree, const std::vector<Pose>& X_WB,
                     const std::vector<SpatialMotion>& V_WB_W,
                     const Eigen::Ref<const Eigen::VectorXd>& v) noexcept {
  double energy = 0;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Eigen::Matrix3d R_BW = X_WB[b].R.transpose();
    energy += KineticEnergy(tree.inertias()[b], R_BW * V_WB_W[b]);
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double v_j = v[tree.v_start() + j];
    energy += 0.5 * tree.joints()[j].armature * v_j * v_j;
  }
  return energy;
}

double PotentialEnergy(const Tree& tree,
                       const std::vector<Pose>& X_WB) noexcept {
  double energy = 0;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Inertia& M_B = tree.inertias()[b];
    energy -= M_B.mass * tree.gravity_W().dot(X_WB[b] * M_B.p_BoG_B);
  }
  return energy;
}

}  // namespace poise
