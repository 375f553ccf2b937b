// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/plants/make_plant.h"

#include "sim/plants/bullet/bullet_plant.h"
#include "sim/plants/mujoco/mujoco_plant.h"

namespace poise {

std::unique_ptr<Plant> MakePlant(const Robot& robot, PlantKind kind,
                                 const PlantSettings& settings) {
  if (kind == PlantKind::kMujoco) {
    return std::make_unique<MujocoPlant>(robot, settings);
  }
  return std::make_unique<BulletPlant>(robot, settings);
}

}  // namespace poise
