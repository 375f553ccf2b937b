// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "robot/robot.h"

namespace poise {

/// Whether, in robot.q_nominal, the left foot is to the right of the other one,
/// as their own axes have it.
/// @pre two feet, left one first; so below.
bool AreFeetSwapped(const Robot& robot);

/// Why robot.q_nominal is no posture to stand in, in words; empty where it is
/// one: joints inside their limits, both soles flat on the ground (to 5 mm and
/// 0.02 rad), the left one to the left, and the center of mass over them.
std::string WhyNotStanding(const Robot& robot);

}  // namespace poise
