// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {

/// Finds a standing posture by inverse kinematics with the hierarchical solver.
/// Both soles lie flat on the ground (z = 0), side by side and facing +x, with their
/// middle at the world's origin. The center of mass is above the middle. If half of
/// an ankle's torque could not hold it there on one foot, the center of mass is
/// nearer to the ankles. Each step minimizes by priority:
///  1. joint limits, with 0.05 rad or 5 % of the range to spare, and couplings,
///  2. the soles' tilt, height, heading and place,
///  3. the distance of the center of mass from there, in the plane,
///  4. the lean of the base, and how far the feet are off their rest distance,
///  5. the distance from the joints of robot->q_nominal, with the knees bent by
///     0.6 rad where those have them straight.
///
/// Writes robot->q_nominal and robot->can_stand. Throws std::invalid_argument
/// with the reason if no such posture is found.
/// pre: two feet, left one first.
void StandUp(Robot* robot);

/// Makes a robot as MakeRobot(), and calls StandUp() if the profile gives no
/// posture. Throws as MakeRobot() and StandUp(), with the name of the file.
Robot MakeStandingRobot(const UrdfDocument& urdf, const Profile& profile = {},
                        std::vector<Finding>* findings = nullptr);

/// Reads a robot from a URDF file, as MakeStandingRobot().
///
/// @param findings  as LoadRobot()'s.
Robot LoadStandingRobot(const std::filesystem::path& urdf,
                        const Profile& profile = {},
                        std::vector<Finding>* findings = nullptr);

}  // namespace poise
