// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/tools/studies/robot_trials.h"

namespace poise {

/// Returns the head of the table of robots in Markdown, two lines.
std::string RobotsHead(bool pictures);

/// Returns the row of a robot. With `pictures`, the row shows the picture that
/// WriteRobotsPage() draws.
std::string RobotRow(const RobotTrial& trial, bool pictures);

/// Returns one document about all robots: SI units, null for a missing value.
nlohmann::ordered_json RobotsToJson(const std::vector<RobotTrial>& trials);

/// Writes the table to FOLDER/robots.md, and a picture of each robot in its
/// nominal posture to FOLDER/figures/robots/NAME.png. Throws
/// std::invalid_argument if a file cannot be written.
void WriteRobotsPage(const std::vector<RobotTrial>& trials,
                     const std::filesystem::path& folder);

}  // namespace poise
