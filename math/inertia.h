// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// The inertia of a rigid body, in the axes of a frame B fixed in it.
struct Inertia {
  double mass = 0;                                    ///< kg.
  Eigen::Vector3d p_BoG_B = Eigen::Vector3d::Zero();  ///< Center of mass, m.
  Eigen::Matrix3d I_G_B = Eigen::Matrix3d::Zero();    ///< About G, kg m2.
};

}  // namespace poise
