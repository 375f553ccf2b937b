// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// Velocity limit that control assumes if a joint has none, in rad/s or m/s. It
/// is above the speed of real limbs.
constexpr double kAssumedVelocity = 30;

/// Returns whether a joint's value is inside its limits, with a tolerance of
/// 1e-6 rad or m.
bool IsWithin(const JointLimits& limits, double q);

/// Returns the message for a joint outside its limits: "'l_knee' is at 9, must
/// be inside its limits, 0 to 2".
std::string SayOutside(const std::string& joint, const JointLimits& limits,
                       double q);

/// Returns the largest violation of a position limit, in rad or m, or 0 if all
/// joints are inside their limits.
double JointViolation(const RobotModel& model, const Eigen::VectorXd& q);

/// Returns the configuration at rest, with the base at the world's origin. Each
/// joint is at zero or, if zero is outside its limits, at the nearer limit.
Eigen::VectorXd RestConfiguration(const RobotModel& model);

}  // namespace poise
