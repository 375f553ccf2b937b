// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Returns, by joint, whether it hangs: neither the joint nor any joint beyond
/// it has a motor, as in a hand without drives. Only a motion of the bodies
/// before a hanging joint can move the joint. So tasks leave its posture out:
/// a robot would shake its trunk to hold a finger.
std::vector<bool> FindHangingJoints(const RobotModel& model);

}  // namespace poise
