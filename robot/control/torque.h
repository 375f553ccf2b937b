// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/tick.h"
#include "robot/control/contacts.h"

namespace poise {

/// The joint torques that make a solution happen, (10):
///     tau = M_u v̇ + N_u - J_{c,u}' lambda.
///
/// @param y    [v̇ (nv); lambda (6 per foot)].
/// @param tau  by joint, N m or N.
/// Does not allocate.
void ComputeTorque(const Tick& tick, const std::vector<ContactTick>& contacts,
                   const Eigen::VectorXd& y, Eigen::VectorXd* tau) noexcept;

}  // namespace poise
