// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "robot/robot.h"

namespace poise {

/// Why, in robot.q_nominal, the feet are no left and right foot of one robot, as
/// their own axes have it; empty where they are.
/// @pre two feet, left one first; so below.
std::string WhyNoPairOfFeet(const Robot& robot);

/// Why robot.q_nominal is no posture to stand in, in words; empty where it is
/// one: joints inside their limits and as they are coupled, both soles flat on
/// the ground (to 5 mm and 0.02 rad), the left one to the left, the middle
/// between them at the origin, facing x, and the center of mass over them.
std::string WhyNotStanding(const Robot& robot);

}  // namespace poise
