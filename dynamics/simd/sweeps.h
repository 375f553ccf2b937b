// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/recursion.h"
#include "poise/dynamics/simd/lanes.h"
#include "poise/dynamics/simd/mass_moments.h"
#include "poise/dynamics/tree.h"

namespace poise {

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
