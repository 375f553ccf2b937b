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
/// Both soles lie flat on the ground (z = 0), side by side and facing +x, with
/// their middle at the origin of the world. The center of mass is above the
/// origin. If half of an ankle's torque could not hold the robot there on one
/// foot, the center of mass is as much nearer to the ankles as needed.
///
/// Each step of the search minimizes errors, in this order of priority:
///  1. joint limits, with a margin of 5 % of the range, at most 0.05 rad or m;
///     and couplings,
///  2. tilt, height, heading and position of the soles,
///  3. horizontal distance of the center of mass from its target,
///  4. lean of the base, and deviation from the rest distance of the feet,
///  5. distance of the joints from robot->q_nominal, with the knees bent by
///     0.6 rad if they are straight in q_nominal.
///
/// Writes robot->q_nominal and robot->can_stand. Throws std::invalid_argument
/// with the reason if no such posture is found.
/// pre: two feet, the left one first.
void StandUp(Robot* robot);

/// Makes a robot like MakeRobot(). If the profile gives no standing posture,
/// calls StandUp(). Throws what MakeRobot() and StandUp() throw, with the file
/// name in the message.
Robot MakeStandingRobot(const UrdfDocument& urdf, const Profile& profile = {},
                        std::vector<Finding>* findings = nullptr);

/// Reads a robot from a URDF file, then does the same as MakeStandingRobot().
///
/// @param findings  see LoadRobot().
Robot LoadStandingRobot(const std::filesystem::path& urdf,
                        const Profile& profile = {},
                        std::vector<Finding>* findings = nullptr);

}  // namespace poise
