// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant_settings.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Returns the start state of a robot, at rest. The robot is in its nominal
/// posture with both soles parallel to the ground's slope. It is turned by the
/// heading, lifted by the drop, and its feet are around the place. Joints
/// outside the legs are offset at random, from the seed, inside their limits.
State MakeStartState(const Robot& robot, const StartSettings& start,
                     const Ground& ground, unsigned seed);

}  // namespace poise
