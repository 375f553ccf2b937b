// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/recursion.h"
#include "dynamics/tree.h"
#include "math/spatial.h"
#include "math/vector6.h"

namespace poise {

/// The derivatives of tau(q, v, v̇) = M v̇ + N - sum of J_b' F_b, each nv x nv.
/// Configurations are varied as Integrate() does, q [+] dq, with the entries of
/// v, v̇ and F_b held: they are in world axes, and do not turn with the bodies.
struct RneaDerivatives {
  explicit RneaDerivatives(const Tree& tree);

  Eigen::MatrixXd dtau_dq;     ///< Columns 3-5 are 0: nothing hangs on p_WB.
  Eigen::MatrixXd dtau_dv;     ///< Columns 3-5 are 0: nor on a uniform motion.
  Eigen::MatrixXd dtau_dvdot;  ///< M.

  /// Scratch, about the base's origin and in world axes, [angular; linear].
  Recursion recursion;
  std::vector<Matrix6d> I;  ///< Inertia of the subtree.
  std::vector<Matrix6d> B;  ///< Sum of x -> d(V x* I V) for d(V) = x.
  std::vector<Vector6d> F;  ///< Force on the subtree, less that from outside.
  /// Sum of x -> [x x n; x x f] of what acts on the subtree from outside.
  std::vector<Eigen::Matrix<double, 6, 3>> E;
  std::vector<Vector6d> V;  ///< Velocity of the body.
  std::vector<Vector6d> A;  ///< Its acceleration, less gravity.
  std::vector<Vector6d> S;  ///< Velocity at unit rate of its joint.
};

/// Computes them analytically.
/// @param q, v, vdot  see Tree.
/// @param F_Bo_W      what acts from outside, as in ComputeRnea().
/// Costs O(n depth), for 50 joints about 17 times RNEA. Does not allocate, does
/// not throw.
/// Source: Singh, Russell and Wensing, "Efficient analytical derivatives of
/// rigid-body dynamics using spatial vector algebra", RA-L 7(2), 2022, without
/// the forces from outside; rearranged, and derived in derivatives.cc.
void ComputeRneaDerivatives(const Tree& tree,
                            const Eigen::Ref<const Eigen::VectorXd>& q,
                            const Eigen::Ref<const Eigen::VectorXd>& v,
                            const Eigen::Ref<const Eigen::VectorXd>& vdot,
                            const std::vector<SpatialForce>& F_Bo_W,
                            RneaDerivatives* out) noexcept;

}  // namespace poise
