// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// Returns the reason why the two feet, in robot.q_nominal, are not a left and a
/// right foot by the axes of their soles, or "" if they are.
/// @pre The robot has two feet, the left one first.
std::string WhyNoPairOfFeet(const Robot& robot);

/// Returns the reason why the robot cannot stand in robot.q_nominal, or "" if it
/// can. The joints must be inside their limits and obey their couplings. Both
/// soles must lie flat on the ground (to 5 mm and 0.02 rad), the left one to the
/// left. The middle between them must be at the origin and face x, and the
/// center of mass must be over the soles.
/// @pre The robot has two feet, the left one first.
std::string WhyNotStanding(const Robot& robot);

}  // namespace poise
