// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"

namespace poise {

/// Computes the kinetic energy v' M v / 2 in J, as the sum over the bodies and
/// the armatures of the joints.
/// @param X_WB    from ComputePoses().
/// @param V_WB_W  from ComputeVelocities() at v.
/// @param v       nv, see Tree; read for the armatures.
/// Costs O(n). Does not allocate, does not throw.
double KineticEnergy(const Tree& tree, const std::vector<Pose>& X_WB,
                     const std::vector<SpatialMotion>& V_WB_W,
                     const Eigen::Ref<const Eigen::VectorXd>& v) noexcept;

/// Computes the potential energy -m g_W' p_WG in J, with m the total mass. It
/// is zero with the center of mass G at the world's origin.
/// @param X_WB  from ComputePoses().
/// Costs O(n). Does not allocate, does not throw.
double PotentialEnergy(const Tree& tree,
                       const std::vector<Pose>& X_WB) noexcept;

}  // namespace poise
