// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/contacts.h"

namespace poise {

/// Computes the joint torques of a solution, (10):
///     tau = M_u v̇ + N_u - J_{c,u}' lambda.
///
/// @param y    [v̇ (nv); lambda (6 per foot)].
/// @param tau  by joint, N m or N.
/// Does not allocate.
void ComputeTorque(const Tick& tick, const std::vector<ContactTick>& contacts,
                   const Eigen::VectorXd& y, Eigen::VectorXd* tau) noexcept;

/// Computes the residual of the unactuated rows of the dynamics, (9), summed over
/// the rows,
///     | M_l v̇ + N_l - J_{c,l}' lambda |,
/// relative to the sum of the moduli of all its terms, or to `scale` where that is
/// more. If it is above rounding, the torques of ComputeTorque() do not produce the
/// accelerations of y. NaN if y has a NaN. Does not allocate.
double DynamicsResidual(const Tick& tick,
                        const std::vector<ContactTick>& contacts,
                        const Eigen::VectorXd& y, double scale) noexcept;

}  // namespace poise
