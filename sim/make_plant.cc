// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/make_plant.h"

#include <stdexcept>

#include "sim/bullet_plant.h"

namespace poise {

std::unique_ptr<Plant> MakePlant(const Robot& robot, PlantKind kind,
                                 const PlantSettings& settings) {
  if (kind == PlantKind::kMujoco) {
    throw std::invalid_argument("plant: mujoco is not there yet");
  }
  return std::make_unique<BulletPlant>(robot, settings);
}

}  // namespace poise
