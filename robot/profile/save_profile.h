// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <ostream>

#include "robot/profile/profile.h"
#include "robot/robot.h"

namespace poise {

/// Writes what is known of a robot beside its URDF as a profile, with comments,
/// that LoadRobot() makes the same robot of, to nine digits.
///
/// @param profile  the one the robot was loaded with: what it says of locked
///                 joints, mimics and tasks is written as well.
void WriteProfile(const Robot& robot, const Profile& profile,
                  std::ostream* stream);

/// The same to a file. Throws std::invalid_argument where it cannot be written.
void SaveProfile(const Robot& robot, const Profile& profile,
                 const std::filesystem::path& file);

}  // namespace poise
