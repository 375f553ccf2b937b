// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// The velocity limit that control assumes for a joint without one, in rad/s or
/// m/s. A limb moves slower.
constexpr double kAssumedVelocity = 30;

/// Returns whether a joint's value is inside its limits, up to 1e-6.
bool IsWithin(const JointLimits& limits, double q);

/// Returns "'l_knee' is at 9, must be inside its limits, 0 to 2".
std::string SayOutside(const std::string& joint, const JointLimits& limits,
                       double q);

/// Returns the largest violation of a position limit, in rad or m, or 0 if all
/// joints are inside their limits.
double JointViolation(const RobotModel& model, const Eigen::VectorXd& q);

/// Returns the configuration at rest: each joint at zero or, if zero is outside
/// its limits, at the nearer limit; the base at the world's origin.
Eigen::VectorXd RestConfiguration(const RobotModel& model);

}  // namespace poise
