// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {

/// Stands a robot up: finds base and joints such that both soles lie flat on the
/// ground (z = 0), side by side and facing +x, their middle at the world's
/// origin, and the center of mass is over it or, where an ankle could not hold it
/// there on one foot with half of its torque, as much nearer to the ankles; by
/// inverse kinematics with the hierarchical solver. Each step minimizes, one after
/// the other,
///  1. joint limits, with 0.05 rad or 5 % of the range to spare, and couplings,
///  2. the soles' tilt, height, heading and place,
///  3. the distance of the center of mass from there, in the plane,
///  4. the lean of the base, and how far the feet are off their rest distance,
///  5. the distance from the joints of robot->q_nominal, with the knees bent by
///     0.6 rad where those have them straight.
///
/// Writes robot->q_nominal and robot->can_stand. Throws std::invalid_argument
/// with the reason where no such posture is found.
/// pre: two feet, left one first.
void StandUp(Robot* robot);

/// Makes a robot as MakeRobot(), and stands it up if the profile gives no posture
/// to stand in. Throws as MakeRobot() and StandUp(), naming the file.
Robot MakeStandingRobot(const UrdfDocument& urdf, const Profile& profile = {},
                        std::vector<Finding>* findings = nullptr);

/// Reads a robot from a URDF file, as MakeStandingRobot().
///
/// @param findings  as LoadRobot()'s.
Robot LoadStandingRobot(const std::filesystem::path& urdf,
                        const Profile& profile = {},
                        std::vector<Finding>* findings = nullptr);

}  // namespace poise
