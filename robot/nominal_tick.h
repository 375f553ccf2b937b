// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tick.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the kinematics and dynamics of a robot that rests in
/// robot.q_nominal. Allocates.
Tick NominalTick(const Robot& robot);

}  // namespace poise
