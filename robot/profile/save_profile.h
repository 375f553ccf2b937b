// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <ostream>

#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"

namespace poise {

/// Writes a profile with comments. LoadRobot() makes the same robot from this
/// profile, with numbers rounded to nine digits.
///
/// @param profile  the profile that the robot was loaded with. Its `forward`,
///                 `left` and `right`, locked joints, mimics and tasks are
///                 written as well.
void WriteProfile(const Robot& robot, const Profile& profile,
                  std::ostream* stream);

/// Writes the profile to a file, as WriteProfile() does to a stream. Throws
/// std::invalid_argument if the file cannot be written, or is the file that the
/// profile was read from.
void SaveProfile(const Robot& robot, const Profile& profile,
                 const std::filesystem::path& file);

}  // namespace poise
