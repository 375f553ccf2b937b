// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace poise {

/// The relative precision to expect of RiddersJacobian(), for functions that are
/// smooth over three hundredths and evaluated to rounding.
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
