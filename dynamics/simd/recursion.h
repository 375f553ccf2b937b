// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/simd/lanes.h"
#include "poise/dynamics/simd/mass_moments.h"
#include "poise/dynamics/tree.h"

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
/// | member | of each body | meaning | point | filled by |
/// | sine, cosine | 1 | of the joint's angle | | SweepPoses |
/// | R_WB, R_WP | 3 x 3 | orientation, and the parent's | | SweepPoses |
/// | p_PB_W | 3 | from the parent's origin to its own | | SweepPoses |
/// | p_OB_W | 3 | from the base's origin to its own | | SweepPoses |
/// | turn_W, slide_W | 3 | velocity at unit joint rate | own | SweepPoses |
/// | w_WB, w_WP | 3 | angular velocity, the parent's | | SweepAccelerations |
/// | alpha_WB, alpha_WP | 3 | angular acceleration, the parent's | | same |
/// | a_WB | 3 | classical acceleration, less gravity | own | same |
/// | M_W | 10 | mass moments of the body | own | SweepInertias |
/// |     |    | then of its subtree | own | SumInertias |
/// | F_W | 6 | force that moves the body so | own | SweepForces |
/// |     |   | then its subtree | own | SumForces |
/// | H_W | 6 | momentum of the subtree at unit joint rate | own | SweepMomenta |
/// | zero | (nv in all) | zeros | | the constructor |
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
  Force3Array F_W;
  Force3Array H_W;
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

/// The force that each body needs. After SweepAccelerations(),
/// SweepInertias().
void SweepForces(const Tree& tree, Recursion* recursion) noexcept;

/// Turns each body's into its subtree's.
void SumInertias(const Tree& tree, Recursion* recursion) noexcept;
void SumForces(const Tree& tree, Recursion* recursion) noexcept;

/// The momentum of each subtree at unit rate of its joint. After SumInertias().
void SweepMomenta(const Tree& tree, Recursion* recursion) noexcept;

/// The generalized forces: [n; f] of the base, then those of the joints, from
/// the forces on the subtrees. After SumForces().
void ProjectForces(const Tree& tree, const Recursion& recursion,
                   Eigen::Ref<Eigen::VectorXd> tau) noexcept;

}  // namespace poise
