// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "dynamics/energy.h"

#include <Eigen/Geometry>

namespace poise {

using Eigen::Vector3d;

double KineticEnergy(const Tree& tree, const std::vector<Pose>& X_WB,
                     const std::vector<Vector6d>& V_WB_W,
                     const Eigen::Ref<const Eigen::VectorXd>& v) noexcept {
  double twice = 0;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Inertia& M_B = tree.inertias()[b];
    const Vector3d w_WB_W = V_WB_W[b].head<3>();
    const Vector3d w_WB_B = X_WB[b].R.transpose() * w_WB_W;
    const Vector3d v_WG_W =
        V_WB_W[b].tail<3>() + w_WB_W.cross(X_WB[b].R * M_B.p_BoG_B);
    twice += M_B.mass * v_WG_W.squaredNorm() + w_WB_B.dot(M_B.I_G_B * w_WB_B);
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double v_j = v[tree.v_start() + j];
    twice += tree.joints()[j].armature * v_j * v_j;
  }
  return 0.5 * twice;
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
