// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"

namespace poise {

/// Computes the joint-space regressor Y. The generalized forces of a motion are
/// linear in the inertial parameters pi:
///     Y(q, v, v̇) pi = tau = M v̇ + N.
/// pi has ten parameters for each body B, about its origin and in its axes,
///     [m; m p_BoG (3); Ixx; Iyy; Izz; Ixy; Ixz; Iyz],
/// and then the armature of each joint. The mass of a fixed link belongs to the
/// body that carries the link. The force on a body is linear in its parameters,
///     n = h x a + I alpha + w x I w,   f = m a + [alpha]x h + [w]x [w]x h,
/// with h = m p_BoG and a the acceleration less gravity. The rows of the joint
/// that moves the body, and of all joints between it and the base, are S_j' [n;
/// f].
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

/// Returns the inertial parameters pi of a tree, in kg, kg m and kg m2. They
/// are the initial values of an identification. Allocates.
Eigen::VectorXd MakeInertialParameters(const Tree& tree);

}  // namespace poise
