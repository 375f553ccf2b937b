// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant_settings.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Returns the start state, at rest. The nominal posture is rotated by the ground's
/// slope and the heading, moved to the place, and lifted by the drop. Joints outside
/// the legs get random offsets from the seed, inside their limits.
State MakeStartState(const Robot& robot, const StartSettings& start,
                     const Ground& ground, unsigned seed);

}  // namespace poise
