// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace poise {

/// How far from x RiddersJacobian() looks: a function is to be smooth so far.
inline constexpr double kRiddersReach = 0.033;

/// The precision to expect of RiddersJacobian(), for functions evaluated to
/// rounding: relative to the derivative, and to what it is added up from where
/// that cancels. In the random trees of tree_cases.h, of 14 links of 1 kg in
/// steps of 0.3 m, that is 10 m/s for velocities; 100 m/s2 for accelerations,
/// |v|^2 0.3 m over some links; 300 N (m) for momenta; 1000 for torques and
/// powers, to which gravity and inertias of all links add.
inline constexpr double kRiddersPrecision = 1e-9;

/// The Jacobian of a function at x, by Ceres' numeric differentiation with
/// Ridders' extrapolation.
Eigen::MatrixXd RiddersJacobian(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& x);

/// The derivative of a function of time at 0.
Eigen::VectorXd RiddersRate(
    const std::function<Eigen::VectorXd(double)>& function);

}  // namespace poise
