// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// Returns the path of a robot's profile, or an empty path if none is found.
/// The places are, in this order:
///  1. the file in the URDF's folder with the URDF's name and the ending .yaml;
///  2. the file NAME.yaml in `folder`, where NAME is the robot's name, the name
///     of the URDF file, or the first words of one of them: g1 for g1_29dof.
///     Case is ignored, and the longest NAME is chosen.
///
/// @param name    the robot's name, from the URDF's root element.
/// @param urdf    the robot's URDF file, which is not opened.
/// @param folder  the folder of profiles, which may be missing.
/// Does not throw if a file or the folder is missing.
std::filesystem::path FindProfile(
    const std::string& name, const std::filesystem::path& urdf,
    const std::filesystem::path& folder = "robot/profiles");

}  // namespace poise
