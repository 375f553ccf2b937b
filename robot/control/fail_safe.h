// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/contacts.h"

namespace poise {

/// Computes the fail-safe torques: gravity compensation with the weight on the
/// feet in contact, and joint damping,
///     tau_j = g_j - (J_{c,u}' lambda_0)_j - d M_jj q̇_j,
/// where g = N - c, and lambda_0 is the minimum-norm solution of
/// J_{c,l}' lambda_0 = g_l.
///
/// @param tick, contacts  of the last valid state.
/// @param v_joints        joint rates; a rate that is not finite is not damped.
/// @param damping         d, 1/s.
/// Does not allocate. tau is finite even if a rate is NaN or infinite.
void ComputeFailSafeTorque(const Tick& tick,
                           const std::vector<ContactTick>& contacts,
                           const Eigen::Ref<const Eigen::VectorXd>& v_joints,
                           double damping, Eigen::VectorXd* tau) noexcept;

}  // namespace poise
