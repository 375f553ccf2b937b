// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// Returns the profile of a robot, or an empty path if there is none. It is
///  1. the file beside the URDF that has the same name and ends in .yaml, else
///  2. the file NAME.yaml in a folder where NAME is the robot's name, the name of
///     the URDF file, or the first words of one of them: g1 for g1_29dof. Case
///     is ignored, and the longest NAME wins.
///
/// @param name    of the robot: the attribute of the URDF's root element.
/// @param urdf    the file of the robot; it is not opened.
/// @param folder  the folder of profiles; it may be missing.
/// Does not throw because of a file that is missing.
std::filesystem::path FindProfile(
    const std::string& name, const std::filesystem::path& urdf,
    const std::filesystem::path& folder = "robot/profiles");

}  // namespace poise
