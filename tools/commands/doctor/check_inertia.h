// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Whether the mass matrix M of a robot at rest, its joints as near zero as
/// their limits let them, can be inverted. Adds a finding that names the joint
/// to blame where it cannot, or where that loses half the digits or more.
///
/// Returns the smallest eigenvalue of M, scaled to a diagonal of 1; nothing
/// where M is singular or worse, or the robot has over 500 joints. Costs O(n^3).
std::optional<double> CheckInertia(const RobotModel& model,
                                   std::vector<Finding>* findings);

}  // namespace poise
