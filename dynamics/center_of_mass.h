// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"

namespace poise {

/// CenterOfMass holds the motion of a robot's center of mass G in world axes:
///     p_WG = sum of m_b p_WG_b / m,   v_WG = J_WG v,   a_WG = J_WG v̇ + bias.
/// Column j of J_WG is the linear momentum of the subtree of joint j at unit
/// rate, divided by the mass m. The bias is the force on all bodies at v̇ = 0
/// and g = 0, divided by m. The errors e_p and e_v of the paper's (20) compare
/// p_WG and v_WG with their references. J_WG and bias are the lower halves of
/// H_G and its bias, (19), divided by m. A tree without mass has p_WG = p_WB
/// and zeros else.
struct CenterOfMass {
  explicit CenterOfMass(const Tree& tree)
      : J_WG(Eigen::Matrix3Xd::Zero(3, tree.nv())) {}

  Eigen::Vector3d p_WG = Eigen::Vector3d::Zero();  ///< m.
  Eigen::Vector3d v_WG = Eigen::Vector3d::Zero();  ///< m/s.
  Eigen::Matrix3Xd J_WG;                           ///< 3 x nv.
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  ///< J̇v, m/s2.
};

/// Computes the center of mass at (q, v), see Tree. The mass of a fixed base is
/// included.
/// The controller runs ComputeTick()'s step 3, ComputeCentroidalDynamics,
/// instead; the test Tick.HasTheCenterOfMass holds the two equal.
/// @param scratch  made for this tree.
/// Costs O(n). Does not allocate, does not throw.
void ComputeCenterOfMass(const Tree& tree,
                         const Eigen::Ref<const Eigen::VectorXd>& q,
                         const Eigen::Ref<const Eigen::VectorXd>& v,
                         Recursion* scratch, CenterOfMass* out) noexcept;

}  // namespace poise
