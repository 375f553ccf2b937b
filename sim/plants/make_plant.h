// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>

#include "robot/robot.h"
#include "sim/plants/plant.h"
#include "sim/scenario.h"

namespace poise {

/// The plant that a scenario asks for. Throws std::invalid_argument if it
/// cannot represent the robot.
std::unique_ptr<Plant> MakePlant(const Robot& robot, PlantKind kind,
                                 const PlantSettings& settings);

}  // namespace poise
