// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/robot.h"
#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// Guesses the feet of a robot in which FindFeet() finds none: the two lowest
/// bodies at the end of a chain, at rest, that are no arms by their names. The
/// sizes of the soles are those that FindFeet() estimates. The left foot, at
/// larger y, is first. Returns nothing if there are no two such bodies below
/// the root link.
std::vector<Diagnosis::Sole> GuessFeet(const RobotModel& model);

}  // namespace poise
