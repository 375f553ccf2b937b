// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// Returns the names of all plants, the default plant first. make_plant.cc has
/// the table of names and factories; docs/plants.md explains how to add a
/// plant.
std::vector<std::string> PlantNames();

bool IsPlant(const std::string& name);

/// Returns the names of all plants for messages: "bullet or mujoco".
std::string PlantNamesInWords();

/// Makes the plant of a name. Throws std::invalid_argument if the name is
/// unknown, with the known names, or if the plant cannot represent the robot.
std::unique_ptr<Plant> MakePlant(const Robot& robot, const std::string& name,
                                 const PlantSettings& settings);

}  // namespace poise
