// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <vector>

#include "poise/robot/profile/profile.h"
#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// Examines a robot file. Errors in the robot file become findings. Throws
/// Refusal if the profile does not match the robot.
///
/// Takes less than 10 s and 1 GiB. To limit the time, M is not computed for
/// more than 500 joints. Standing and parity are not examined for more than 200
/// joints, 1000 links or 10000 shapes.
///
/// @param packages  folders of packages with meshes, see FindMesh().
/// @param longest  processor time of the simulation, s; see WhyFalls().
Diagnosis Diagnose(const std::filesystem::path& urdf,
                   const Profile& profile = {},
                   const std::vector<std::filesystem::path>& packages = {},
                   double longest = 5);

}  // namespace poise
