// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/simd/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// How ComputeAba() ended.
enum class AbaStatus {
  kOk,
  /// M is singular, or not positive: some motion, such as that of a joint with a
  /// massless body, has no inertia, and no acceleration is the answer. vdot is
  /// NaN. Give the body a mass or the joint an armature, or lock the joint.
  kSingular,
  /// A number given was not finite, the base's quaternion was 0, or the answer
  /// overflows. vdot is NaN.
  kNotFinite,
};

/// Scratch of ComputeAba().
struct AbaScratch {
  explicit AbaScratch(const Tree& tree);

  /// Resistance of a body to a push when all joints beyond it are free:
  /// [n; f] = [J H; H' M] [alpha; a] + bias, about its origin, world axes.
  struct Body {
    Sym3 J;
    Mat3 H;
    Sym3 M;
    Force3 bias;
  };

  Recursion recursion;
  std::vector<Body> bodies;
  std::vector<Force3> U;  ///< By body: its momentum at unit joint rate.
  std::vector<double> D;  ///< By body: resistance of the joint that moves it.
  std::vector<double>
      u;  ///< By body: force of the joint left to accelerate it.
};

/// Computes the acceleration of a robot, the forward dynamics
///     v̇ = M^-1 (tau - N + sum of J_b' F_b),
/// by the articulated-body algorithm, without M.
///
/// @param q, v     see Tree.
/// @param tau      nv: [torque about the base's origin; force; joints].
/// @param F_Bo_W   what acts on the bodies from outside, as in ComputeRnea().
/// @param scratch  made for this tree.
/// @param vdot     nv, the derivative of v, rad/s2 and m/s2.
/// A joint counts as without inertia if, with those beyond it free, less than
/// 1e-13 is left of what it has with them locked: that much is rounding.
/// Costs O(n): 8 us for 50 joints. Does not allocate, does not throw.
/// Source: Featherstone, "Rigid body dynamics algorithms", 2008, table 7.1, with
/// classical accelerations and all vectors in world axes.
[[nodiscard]] AbaStatus ComputeAba(const Tree& tree,
                                   const Eigen::Ref<const Eigen::VectorXd>& q,
                                   const Eigen::Ref<const Eigen::VectorXd>& v,
                                   const Eigen::Ref<const Eigen::VectorXd>& tau,
                                   const std::vector<SpatialForce>& F_Bo_W,
                                   AbaScratch* scratch,
                                   Eigen::Ref<Eigen::VectorXd> vdot) noexcept;

}  // namespace poise
