// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace poise {

/// Largest distance from x at which RiddersJacobian() evaluates a function. The
/// function must be smooth within this distance.
inline constexpr double kRiddersReach = 0.033;

/// Expected precision of RiddersJacobian() for functions that are evaluated to
/// rounding. It is relative to the derivative or, where terms cancel, to these
/// terms. The random trees of tree_cases.h have 14 links of 1 kg in steps of
/// 0.3 m. Their terms are of the size
///     10 m/s for velocities,
///     100 m/s2 for accelerations: |v|^2 0.3 m over some links,
///     300 N (m) for momenta,
///     1000 for torques and powers: gravity and inertias of all links add up.
inline constexpr double kRiddersPrecision = 1e-9;

/// Returns the Jacobian of a function at x, by Ceres' numeric differentiation
/// with Ridders' extrapolation.
Eigen::MatrixXd RiddersJacobian(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& x);

/// Returns the derivative of a function of time at time 0.
Eigen::VectorXd RiddersRate(
    const std::function<Eigen::VectorXd(double)>& function);

}  // namespace poise
