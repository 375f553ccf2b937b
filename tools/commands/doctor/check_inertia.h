// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Checks if the mass matrix M of a robot can be inverted. The joints are as
/// near zero as their limits allow. If M cannot be inverted, or if the
/// inversion loses at least half the digits, adds a finding that names the
/// joint.
///
/// Returns the smallest eigenvalue of M, scaled to a diagonal of 1. Returns
/// nothing if M is singular, indefinite or not finite, or if the robot has more
/// than 500 joints. Costs O(n^3).
std::optional<double> CheckInertia(const RobotModel& model,
                                   std::vector<Finding>* findings);

}  // namespace poise
