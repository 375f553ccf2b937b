// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/make_plant.h"

#include <stdexcept>

#include "poise/robot/finding.h"
#include "poise/sim/plants/bullet/bullet_plant.h"
#include "poise/sim/plants/mujoco/mujoco_plant.h"

namespace poise {

namespace {

template <typename P>
std::unique_ptr<Plant> Make(const Robot& robot, const PlantSettings& settings) {
  return std::make_unique<P>(robot, settings);
}

struct PlantEntry {
  const char* name;
  std::unique_ptr<Plant> (*make)(const Robot&, const PlantSettings&);
};

// A new plant needs a row here, and no other change outside its own folder.
constexpr PlantEntry kPlants[] = {
    {"bullet", Make<BulletPlant>},
    {"mujoco", Make<MujocoPlant>},
};

}  // namespace

std::vector<std::string> PlantNames() {
  std::vector<std::string> names;
  for (const PlantEntry& plant : kPlants) names.push_back(plant.name);
  return names;
}

bool IsPlant(const std::string& name) {
  for (const PlantEntry& plant : kPlants) {
    if (name == plant.name) return true;
  }
  return false;
}

std::string PlantNamesInWords() {
  const std::vector<std::string> names = PlantNames();
  std::string text = names[0];
  for (std::size_t i = 1; i < names.size(); ++i) {
    text += (i + 1 < names.size() ? ", " : " or ") + names[i];
  }
  return text;
}

std::unique_ptr<Plant> MakePlant(const Robot& robot, const std::string& name,
                                 const PlantSettings& settings) {
  for (const PlantEntry& plant : kPlants) {
    if (name == plant.name) return plant.make(robot, settings);
  }
  throw std::invalid_argument("plant.kind is " + Quoted(name) + ", must be " +
                              PlantNamesInWords());
}

}  // namespace poise
