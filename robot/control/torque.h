// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/contacts.h"

namespace poise {

/// Computes the joint torques that realise a solution y, (10):
///     tau = M_u v̇ + N_u - J_{c,u}' lambda.
///
/// @param y    [v̇ (nv); lambda (6 per foot)].
/// @param tau  by joint, N m or N.
/// Does not allocate.
void ComputeTorque(const Tick& tick, const std::vector<ContactTick>& contacts,
                   const Eigen::VectorXd& y, Eigen::VectorXd* tau) noexcept;

/// Returns the relative residual of a solution in the six unactuated rows of
/// the dynamics, (9): the sum over these rows of
///     | M_l v̇ + N_l - J_{c,l}' lambda |,
/// divided by the sum of the absolute values of all terms, or by `scale` if
/// that is larger. If the residual is above rounding, the torques of
/// ComputeTorque() belong to a motion that the robot cannot make. NaN if y is
/// not finite. Does not allocate.
double DynamicsResidual(const Tick& tick,
                        const std::vector<ContactTick>& contacts,
                        const Eigen::VectorXd& y, double scale) noexcept;

}  // namespace poise
