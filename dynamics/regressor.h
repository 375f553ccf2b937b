// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/simd/recursion.h"
#include "poise/dynamics/tree.h"

namespace poise {

/// Computes the joint-space regressor, which says how the generalized forces of
/// a motion depend on the inertias:
///     Y(q, v, v̇) pi = tau = M v̇ + N,
/// with pi = [10 numbers of each body; armature of each joint], and of a body B,
/// about its origin and in its axes,
///     [m; m p_BoG (3); Ixx; Iyy; Izz; Ixy; Ixz; Iyz].
/// Fixed links count with the body that carries them. The force on a body is
/// linear in its ten numbers,
///     n = h x a + I alpha + w x I w,   f = m a + [alpha]x h + [w]x [w]x h,
/// with h = m p_BoG and gravity in a; its joint and those below take their parts.
///
/// @param q, v, vdot  see Tree.
/// @param scratch     made for this tree.
/// @param Y           nv x (10 bodies + joints), columns as pi, rows as tau of
///                    ComputeRnea(). All of it is written.
/// Costs O(n depth). Does not allocate, does not throw.
/// Source: Atkeson, An and Hollerbach, "Estimation of inertial parameters of
/// manipulator loads and links", IJRR 5(3), 1986.
void ComputeRegressor(const Tree& tree,
                      const Eigen::Ref<const Eigen::VectorXd>& q,
                      const Eigen::Ref<const Eigen::VectorXd>& v,
                      const Eigen::Ref<const Eigen::VectorXd>& vdot,
                      Recursion* scratch,
                      Eigen::Ref<Eigen::MatrixXd> Y) noexcept;

/// The pi of a tree, by which identification starts: kg, kg m, kg m2. Allocates.
Eigen::VectorXd MakeInertialParameters(const Tree& tree);

}  // namespace poise
