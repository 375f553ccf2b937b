// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant_settings.h"
#include "poise/sim/scenario.h"

namespace poise {

/// The state that a robot starts in, at rest: its nominal posture, laid on the
/// ground's slope, turned by the heading, lifted by the drop, its feet about the
/// place, with the joints outside its legs awry by what the seed draws, inside
/// their limits.
State MakeStartState(const Robot& robot, const StartSettings& start,
                     const Ground& ground, unsigned seed);

}  // namespace poise
