// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/simd/lanes.h"
#include "poise/dynamics/simd/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// The derivatives of tau(q, v, v̇) = M v̇ + N - sum of J_b' F_b, each nv x nv.
/// Configurations are varied as Integrate() does, q [+] dq, with the entries of
/// v, v̇ and F_b held: they are in world axes, and do not turn with the bodies.
///
/// | member | shape | meaning | row, column |
/// | dtau_dq | nv x nv | columns 3-5 are 0: nothing hangs on p_WB | as v, as dq |
/// | dtau_dv | nv x nv | columns 3-5 are 0: nor on a uniform motion | as v, as v |
/// | dtau_dvdot | nv x nv | M, symmetric to the bit | as v, as v |
struct RneaDerivatives {
  explicit RneaDerivatives(const Tree& tree);

  Eigen::MatrixXd dtau_dq;
  Eigen::MatrixXd dtau_dv;
  Eigen::MatrixXd dtau_dvdot;

  /// Forces f at points p from a body's origin, and couples n: what tells how
  /// their sum changes when each of them turns about its own point.
  struct Moments {
    Vec3 n;   ///< Sum of n.
    Vec3 f;   ///< Sum of f.
    Mat3 fp;  ///< Sum of f p'.
  };

  /// Scratch, by body, in world axes; motions are about the base's origin O,
  /// which is taken at rest.
  Recursion recursion;
  std::vector<Motion3> S;  ///< Velocity at unit rate of its joint.
  std::vector<Motion3> V;  ///< Velocity.
  std::vector<Motion3> A;  ///< Rate of V less gravity, at O: no one point's.
  /// Twice the momenta of the subtree's elements: the Coriolis forces on it at
  /// one more rad/s, once turned.
  std::vector<Moments> coriolis;
  std::vector<Moments> outside;  ///< What acts on the subtree from outside.
  Force3Array H;                 ///< Momentum of the subtree at S, about O.
  Vec3Array S_coriolis;          ///< Power at S of coriolis, turned by x: y'x.
  Vec3Array S_outside;           ///< The same of outside.
};

/// Computes them analytically.
/// @param q, v, vdot  see Tree.
/// @param F_Bo_W      what acts from outside, as in ComputeRnea().
/// Costs O(n depth), for 50 joints about 6 times RNEA. Does not allocate, does
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
