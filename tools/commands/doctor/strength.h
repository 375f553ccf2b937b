// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Checks if the motors can hold the robot in its standing posture with contact
/// forces that its soles can give. Returns a warning for each motor that is too
/// weak, and one for the robot if the forces cannot balance it. Returns nothing
/// if the robot can stand.
/// @pre robot.can_stand.
std::vector<Finding> FindWeakness(const Robot& robot);

}  // namespace poise
