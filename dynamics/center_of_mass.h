// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/simd/recursion.h"
#include "poise/dynamics/tree.h"

namespace poise {

/// The center of mass G of a robot, world axes:
///     p_WG = sum of m_b p_WG_b / m,   v_WG = J_WG v,   a_WG = J_WG v̇ + bias.
/// Column j of J_WG is the linear momentum that the subtree of joint j has at unit
/// rate, over m; the bias the force on all bodies at v̇ = 0 and g = 0, over m.
/// In the paper's (20) p_WG and v_WG are what e_p and e_v compare; J_WG and bias
/// are the lower halves of H_G and its bias, (19), over m.
/// All zero, but for p_WG = p_WB, for a tree without mass.
struct CenterOfMass {
  explicit CenterOfMass(const Tree& tree)
      : J_WG(Eigen::Matrix3Xd::Zero(3, tree.nv())) {}

  Eigen::Vector3d p_WG = Eigen::Vector3d::Zero();  ///< m.
  Eigen::Vector3d v_WG = Eigen::Vector3d::Zero();  ///< m/s.
  Eigen::Matrix3Xd J_WG;                           ///< 3 x nv.
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  ///< J̇v, m/s2.
};

/// Computes it at (q, v), see Tree. A fixed base counts with its mass.
/// The controller runs ComputeTick()'s step 3, ComputeCentroidalDynamics, instead;
/// the test Tick.HasTheCenterOfMass holds the two equal.
/// @param scratch  made for this tree.
/// Costs O(n). Does not allocate, does not throw.
void ComputeCenterOfMass(const Tree& tree,
                         const Eigen::Ref<const Eigen::VectorXd>& q,
                         const Eigen::Ref<const Eigen::VectorXd>& v,
                         Recursion* scratch, CenterOfMass* out) noexcept;

}  // namespace poise
