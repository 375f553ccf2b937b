// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// AbaStatus is the result of ComputeAba().
enum class AbaStatus {
  kOk,
  /// M is singular or not positive definite: a motion has no inertia, for
  /// example of a joint with a massless body. vdot is NaN. Give the body a mass
  /// or the joint an armature, or lock the joint.
  kSingular,
  /// An input is not finite, the base's quaternion is 0, or an inertia or the
  /// result overflows. vdot is NaN.
  kNotFinite,
};

/// AbaScratch is the scratch memory of ComputeAba().
struct AbaScratch {
  explicit AbaScratch(const Tree& tree);

  /// Body is the articulated-body inertia [J H; H' M] and bias force of a
  /// subtree with free joints: the force on the body that accelerates it by
  /// [alpha; a] is
  ///     [n; f] = [J H; H' M] [alpha; a] + bias,
  /// about the origin of the body, in world axes.
  struct Body {
    Sym3 J;
    Mat3 H;
    Sym3 M;
    Force3 bias;
  };

  Recursion recursion;
  std::vector<Body> bodies;
  std::vector<Force3> U;  ///< By body: [J H; H' M] S.
  std::vector<double> D;  ///< By body: S' U, inertia of the joint.
  std::vector<double> u;  ///< By body: tau_j - S' bias.
};

/// Computes the acceleration of a robot, the forward dynamics
///     v̇ = M^-1 (tau - N + sum of J_b' F_b),
/// by the articulated-body algorithm, without M.
///
/// @param q, v     see Tree.
/// @param tau      nv: [torque about the base's origin; force; joints].
/// @param F_Bo_W   external forces on the bodies, as in ComputeRnea().
/// @param scratch  made for this tree.
/// @param vdot     nv, the derivative of v, rad/s2 and m/s2.
/// A joint has no inertia if its D, with the joints beyond it free, is below
/// 1e-13 times its D with these joints locked: the remainder is rounding.
/// Costs O(n): 8 us for 50 joints. Does not allocate, does not throw.
/// Source: Featherstone, "Rigid body dynamics algorithms", 2008, table 7.1,
/// with classical accelerations and all vectors in world axes.
[[nodiscard]] AbaStatus ComputeAba(const Tree& tree,
                                   const Eigen::Ref<const Eigen::VectorXd>& q,
                                   const Eigen::Ref<const Eigen::VectorXd>& v,
                                   const Eigen::Ref<const Eigen::VectorXd>& tau,
                                   const std::vector<SpatialForce>& F_Bo_W,
                                   AbaScratch* scratch,
                                   Eigen::Ref<Eigen::VectorXd> vdot) noexcept;

}  // namespace poise
