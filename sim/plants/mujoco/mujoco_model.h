// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// Returns a robot and its ground as MuJoCo's XML. Body i of the tree is
/// MuJoCo's body i + 1, with the name "body<i>". Joint j of the tree is
/// MuJoCo's joint j, counted after the free joint. A sole consists of small
/// spheres at the corners of its polygon, as in Bullet.
///
/// @param excluded  pairs of bodies that do not collide, in addition to
///                  FindNeighbors().
std::string MakeMujocoXml(const Robot& robot, const PlantSettings& settings,
                          const std::vector<std::pair<int, int>>& excluded);

}  // namespace poise
