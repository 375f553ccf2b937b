// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/body_arrays.h"
#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// RneaDerivatives holds the derivatives of tau(q, v, v̇) = M v̇ + N - sum of
/// J_b' F_b. A variation of q is q [+] dq as in Integrate(). The entries of v,
/// v̇ and F_b stay constant: they have world axes and do not turn with the
/// bodies.
///
/// | member | shape | meaning | row, column |
/// | dtau_dq | nv x nv | columns 3-5 are 0: independent of p_WB | v, dq |
/// | dtau_dv | nv x nv | columns 3-5 are 0: independent of v_WB | v, v |
/// | dtau_dvdot | nv x nv | M, symmetric to the bit | v, v |
struct RneaDerivatives {
  explicit RneaDerivatives(const Tree& tree);

  Eigen::MatrixXd dtau_dq;
  Eigen::MatrixXd dtau_dv;
  Eigen::MatrixXd dtau_dvdot;

  /// Moments sums forces f at points p from a body's origin, and couples n.
  /// They give the change of the total force when each force turns about its
  /// own point.
  struct Moments {
    Vec3 n;   ///< Sum of n.
    Vec3 f;   ///< Sum of f.
    Mat3 fp;  ///< Sum of f p'.
  };

  /// Scratch memory by body, in world axes. Motions are about the base's origin
  /// O, relative to the velocity of O.
  Recursion recursion;
  std::vector<Motion3> S;  ///< Velocity at unit rate of its joint.
  std::vector<Motion3> V;  ///< Velocity.
  std::vector<Motion3> A;  ///< Rate of V less gravity: spatial, at O.
  /// Twice the momenta of the subtree's elements. Turn() of them about an axis
  /// is the Coriolis force on the subtree for 1 rad/s about this axis.
  std::vector<Moments> coriolis;
  std::vector<Moments> outside;  ///< External forces on the subtree.
  Force3Array H;                 ///< Momentum of the subtree at S, about O.
  Vec3Array S_coriolis;          ///< y: power at S of Turn(coriolis, x) is y'x.
  Vec3Array S_outside;           ///< y: power at S of Turn(outside, x) is y'x.
};

/// Computes the derivatives analytically.
/// @param q, v, vdot  see Tree.
/// @param F_Bo_W      external forces, as in ComputeRnea().
/// Costs O(n depth), for 50 joints about 6 times RNEA. Does not allocate, does
/// not throw.
/// Source: Singh, Russell and Wensing, "Efficient analytical derivatives of
/// rigid-body dynamics using spatial vector algebra", RA-L 7(2), 2022, which
/// has no external forces. The form used here is derived in derivatives.cc.
void ComputeRneaDerivatives(const Tree& tree,
                            const Eigen::Ref<const Eigen::VectorXd>& q,
                            const Eigen::Ref<const Eigen::VectorXd>& v,
                            const Eigen::Ref<const Eigen::VectorXd>& vdot,
                            const std::vector<SpatialForce>& F_Bo_W,
                            RneaDerivatives* out) noexcept;

}  // namespace poise
