// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/robot.h"

namespace poise {

/// Returns the largest distance of the center of mass from an ankle's axis at
/// which half of the ankle's torque holds the robot on that foot alone, m: 0.5
/// tau_max / (m g). The other half is kept for motion. Infinite if the robot
/// file gives no effort limit.
/// @param ankle  index of the joint.
double AnkleReach(const Robot& robot, int ankle);

}  // namespace poise
