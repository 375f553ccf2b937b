// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/simd/lanes.h"
#include "poise/dynamics/simd/mass_moments.h"
#include "poise/dynamics/tree.h"

namespace poise {

/// Recursion is the scratch memory of the recursions over a tree, shared by all
/// algorithms. A call reads only what the same call has written.
///
/// All vectors have world axes, and spatial vectors of a body are about its own
/// origin. From body to body vectors are shifted and never rotated. The
/// position of the world's origin is not used, so that long chains lose no
/// digits. Each array has one entry for each body, as a structure of arrays.
/// The sums from parent to child are sequential loops of few additions;
/// everything else is a loop with lanes, see README.md.
///
/// | member | size per body | meaning | point | filled by |
/// | sine, cosine | 1 | sine and cosine of the joint's angle | | SweepPoses |
/// | R_WB, R_WP | 3 x 3 | orientation, and the parent's | | SweepPoses |
/// | p_PB_W | 3 | position from the parent's origin | | SweepPoses |
/// | p_OB_W | 3 | position from the base's origin | | SweepPoses |
/// | turn_W, slide_W | 3 | velocity at unit joint rate | own | SweepPoses |
/// | w_WB, w_WP | 3 | angular velocity, the parent's | | SweepAccelerations |
/// | alpha_WB, alpha_WP | 3 | angular acceleration, the parent's | | as w_WB |
/// | a_WB | 3 | classical acceleration less gravity | own | as w_WB |
/// | M_W | 10 | mass moments of the body | own | SweepInertias |
/// |     |    | then mass moments of its subtree | own | SumInertias |
/// | F_W | 6 | force on the body at its acceleration | own | SweepForces |
/// |     |   | then force on its subtree | own | SumForces |
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

/// Computes the orientations of the bodies, their positions from the base's
/// origin, and the joint axes at q. The position of the base is not used.
void SweepPoses(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                Recursion* recursion) noexcept;

/// Computes the velocities and accelerations of the bodies at (v, v̇). Gravity
/// enters as an acceleration of the base by -g_W. Call SweepPoses() before.
void SweepAccelerations(const Tree& tree,
                        const Eigen::Ref<const Eigen::VectorXd>& v,
                        const Eigen::Ref<const Eigen::VectorXd>& vdot,
                        const Eigen::Vector3d& g_W,
                        Recursion* recursion) noexcept;

/// Computes the mass moments of each body in world axes. Call SweepPoses()
/// before.
void SweepInertias(const Tree& tree, Recursion* recursion) noexcept;

/// Computes the force that gives each body its acceleration. Call
/// SweepAccelerations() and SweepInertias() before.
void SweepForces(const Tree& tree, Recursion* recursion) noexcept;

/// SumInertias() and SumForces() replace the mass moments and the force of each
/// body by the sums over its subtree.
void SumInertias(const Tree& tree, Recursion* recursion) noexcept;
void SumForces(const Tree& tree, Recursion* recursion) noexcept;

/// Computes the momentum of each subtree at unit rate of its joint. Call
/// SumInertias() before.
void SweepMomenta(const Tree& tree, Recursion* recursion) noexcept;

/// Computes the generalized forces from the forces on the subtrees: [n; f] of a
/// floating base, then one for each joint. Call SumForces() before.
void ProjectForces(const Tree& tree, const Recursion& recursion,
                   Eigen::Ref<Eigen::VectorXd> tau) noexcept;

}  // namespace poise
