// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tree.h"

namespace poise {

/// Integrates a velocity that stays constant in world axes for a time dt:
///     q_out = q [+] v dt = [p_WB + v_WB dt; exp(w_WB dt) R_WB; joints + v dt].
///
/// @param q      nq configuration, see Tree. The quaternion may have any norm
///               but 0, which gives NaN.
/// @param v      nv velocity, see Tree.
/// @param dt     s; may be negative.
/// @param q_out  nq, with a unit quaternion. May be q itself.
/// Costs O(n). Does not allocate, does not throw.
void Integrate(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
               const Eigen::Ref<const Eigen::VectorXd>& v, double dt,
               Eigen::Ref<Eigen::VectorXd> q_out) noexcept;

/// Computes the velocity that leads from one configuration to another in unit
/// time, the inverse of Integrate():   q_from [+] v = q_to.
///
/// @param q_from, q_to  nq; their quaternions may be of any norm but 0.
/// @param v  nv. The rotation takes the shorter way: its norm is at most pi
/// rad. Costs O(n). Does not allocate, does not throw.
void Difference(const Tree& tree,
                const Eigen::Ref<const Eigen::VectorXd>& q_from,
                const Eigen::Ref<const Eigen::VectorXd>& q_to,
                Eigen::Ref<Eigen::VectorXd> v) noexcept;

}  // namespace poise
