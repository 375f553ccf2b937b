// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// Returns a robot and its ground as MuJoCo's XML. Body i of the tree is MuJoCo's body
/// i + 1, called "body<i>"; joint j its joint of the same number after the
/// free joint. A sole consists of small spheres at its polygon's corners, as in Bullet.
///
/// @param excluded  pairs of bodies that do not collide, besides neighbors.
std::string MakeMujocoXml(const Robot& robot, const PlantSettings& settings,
                          const std::vector<std::pair<int, int>>& excluded);

}  // namespace poise
