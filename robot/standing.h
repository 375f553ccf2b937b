// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// Checks from the axes of the soles, in robot.q_nominal, that the two feet are
/// a left and a right foot. Returns the reason if they are not, or "" if they
/// are.
/// @pre The robot has two feet, the left one first.
std::string WhyNoPairOfFeet(const Robot& robot);

/// Returns the reason why the robot cannot stand in robot.q_nominal, or "" if
/// it can. The conditions are:
/// - the joints are inside their limits and obey their mimic couplings;
/// - both soles lie flat on the ground, to 5 mm and 0.02 rad, the left sole to
///   the left;
/// - the midpoint of the soles is at the origin to 5 mm, and the soles point
///   along x to 0.02 rad;
/// - the center of mass is above the ground and over the convex hull of the
///   soles.
///
/// @pre The robot has two feet, the left one first.
std::string WhyNotStanding(const Robot& robot);

}  // namespace poise
