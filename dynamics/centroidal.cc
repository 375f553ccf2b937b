// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/centroidal.h"

#include <cassert>

#include "poise/math/so3.h"

namespace poise {

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
