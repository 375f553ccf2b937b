// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Checks if the motors can hold the robot in its standing posture with contact
/// forces that its soles can give. Returns a warning for each motor that is too
/// weak, and one for the robot if the forces cannot balance it. A motor outside
/// the legs counts if it lacks more than 1e-4 of the robot's weight times the
/// height of its center of mass. Returns nothing if the robot can stand.
///
/// A robot with weak motors may settle into another posture: see WhyFalls().
/// @pre robot.can_stand.
std::vector<Finding> FindWeakness(const Robot& robot);

}  // namespace poise
