// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>

#include "poise/robot/robot.h"

namespace poise {

/// Draws two pictures of the run in RUNS/shove, each as SVG and PNG:
///   shove.png      the robot during the push, in its first step, and at rest;
///   shove-map.png  its footprints from above, with the paths of its center of
///                  mass and of its capture point.
/// Throws std::invalid_argument if a file cannot be read or written, or if the
/// robot took no step.
void DrawShove(const Robot& robot, const std::filesystem::path& runs,
               const std::filesystem::path& pictures);

}  // namespace poise
