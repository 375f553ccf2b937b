// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>

#include "robot/robot.h"

namespace poise {

/// How fast control lets a joint go whose limit is not known: faster than a limb
/// moves, rad/s or m/s.
constexpr double kAssumedVelocity = 30;

/// Whether a joint's value is inside its limits, up to 1e-6.
bool IsWithin(const JointLimits& limits, double q);

/// "'l_knee' is at 9, must be inside its limits, 0 to 2".
std::string SayOutside(const std::string& joint, const JointLimits& limits,
                       double q);

/// How far the joint that is farthest past a limit is past it, rad or m; 0 if all
/// are inside.
double JointViolation(const RobotModel& model, const Eigen::VectorXd& q);

/// The configuration at rest: each joint at zero or, where that is outside its
/// limits, at the nearer of them; the base at the world's origin.
Eigen::VectorXd RestConfiguration(const RobotModel& model);

}  // namespace poise
