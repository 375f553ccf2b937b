// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/recursion.h"
#include "dynamics/tree.h"
#include "math/vector6.h"

namespace poise {

/// Computes the generalized forces of a motion, the inverse dynamics
///     tau = M v̇ + N - sum of J_b' F_b,
/// by the recursive Newton-Euler algorithm: [torque about the base's origin;
/// force; joints], with gravity and the joints' armatures.
///
/// @param q, v, vdot  see Tree; vdot is the derivative of v.
/// @param F_Bo_W      what acts on the bodies from outside, by body or none: the
///                    torque about the body's origin and the force, world axes.
/// @param scratch     made for this tree.
/// @param tau         nv.
/// Costs O(n). Does not allocate, does not throw.
/// Source: Luh, Walker and Paul, "On-line computational scheme for mechanical
/// manipulators", 1980, with all vectors in world axes.
void ComputeRnea(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 const Eigen::Ref<const Eigen::VectorXd>& vdot,
                 const std::vector<Vector6d>& F_Bo_W, Recursion* scratch,
                 Eigen::Ref<Eigen::VectorXd> tau) noexcept;

/// Computes the bias forces N with gravity, tau at v̇ = 0.
void ComputeBias(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v, Recursion* scratch,
                 Eigen::Ref<Eigen::VectorXd> N) noexcept;

/// Computes the bias forces c without gravity: Coriolis and centrifugal.
void ComputeCoriolis(const Tree& tree,
                     const Eigen::Ref<const Eigen::VectorXd>& q,
                     const Eigen::Ref<const Eigen::VectorXd>& v,
                     Recursion* scratch,
                     Eigen::Ref<Eigen::VectorXd> c) noexcept;

}  // namespace poise
