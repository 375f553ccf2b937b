// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/lanes.h"
#include "dynamics/mass_moments.h"
#include "dynamics/tree.h"

namespace poise {

/// Scratch of the recursions over a tree, which all algorithms share. Nothing
/// in it is read by a call that did not write it.
///
/// All vectors have world axes, and those of a body are about its own origin:
/// from body to body they are shifted and never rotated, the world's origin
/// enters nowhere, and long chains lose no digits. Arrays are by body,
/// component by component: a sweep walks the tree for sums alone, a few
/// additions a body, and does the rest for several bodies at once.
///
/// | member | meaning | filled by |
/// | sine, cosine | of the joint's angle | SweepPoses |
/// | R_WB, R_WP | orientation, and the parent's | SweepPoses |
/// | p_PB_W, p_OB_W | origin, from the parent's and the base's | SweepPoses |
/// | turn_W, slide_W | velocity [turn; slide] at unit joint rate | SweepPoses |
/// | w_WB, w_WP | angular velocity, and the parent's | SweepAccelerations |
/// | alpha_WB, alpha_WP | angular acceleration, and the parent's | same |
/// | a_WB | classical acceleration of the origin, less gravity | same |
/// | M_W | mass moments of the body | SweepInertias |
/// |     | then of its subtree | SumInertias |
/// | F_W | wrench to move the body so | SweepForces |
/// |     | then its subtree | SumForces |
/// | H_W | momentum of the subtree at unit joint rate | SweepMomenta |
/// | zero | nv zeros | the constructor |
struct Recursion {
  explicit Recursion(const Tree& tree);

  std::vector<double> sine, cosine;
  Mat3Array R_WB, R_WP;
  Vec3Array p_PB_W, p_OB_W;
  Vec3Array turn_W, slide_W;
  Vec3Array w_WB, w_WP;
  Vec3Array alpha_WB, alpha_WP;
  Vec3Array a_WB;
  MassMomentsArray M_W;
  WrenchArray F_W;
  WrenchArray H_W;
  Eigen::VectorXd zero;
};

/// Where the bodies are at q, but for the position of the base.
void SweepPoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                Recursion* recursion) noexcept;

/// How they move at (v, v̇), where all fall with g_W: a base at rest in a field
/// of gravity accelerates by -g_W. After SweepPoses().
void SweepAccelerations(const Tree& tree,
                        const Eigen::Ref<const Eigen::VectorXd>& v,
                        const Eigen::Ref<const Eigen::VectorXd>& vdot,
                        const Eigen::Vector3d& g_W,
                        Recursion* recursion) noexcept;

/// The mass moments of each body. After SweepPoses().
void SweepInertias(const Tree& tree, Recursion* recursion) noexcept;

/// The wrench that each body needs. After SweepAccelerations(),
/// SweepInertias().
void SweepForces(const Tree& tree, Recursion* recursion) noexcept;

/// Turns each body's into its subtree's.
void SumInertias(const Tree& tree, Recursion* recursion) noexcept;
void SumForces(const Tree& tree, Recursion* recursion) noexcept;

/// The momentum of each subtree at unit rate of its joint. After SumInertias().
void SweepMomenta(const Tree& tree, Recursion* recursion) noexcept;

/// The generalized forces: [n; f] of the base, then those of the joints, from
/// the wrenches on the subtrees. After SumForces().
void ProjectForces(const Tree& tree, const Recursion& recursion,
                   Eigen::Ref<Eigen::VectorXd> tau) noexcept;

}  // namespace poise
