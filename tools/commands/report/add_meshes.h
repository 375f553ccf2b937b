// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace poise {

/// Reads the meshes that the run did not find, and draws them instead of their
/// stand-ins. The places are those of FindMesh().
///
/// @param packages  folders of packages.
/// @param robot     a robot.json, see MakeRobotJson(). If it has no
///                  `unread_meshes`, or if they are malformed, it does not
///                  change.
void AddMeshes(const std::vector<std::filesystem::path>& packages,
               nlohmann::json* robot);

}  // namespace poise
