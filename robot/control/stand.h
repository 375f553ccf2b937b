// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {

/// Finds a standing posture by inverse kinematics, see FindPosture(). Both
/// soles lie flat on the ground (z = 0), side by side and facing +x, with their
/// middle at the origin of the world. The center of mass is above the origin,
/// or nearer to weak ankles. Straight knees are bent by 0.6 rad.
///
/// If the first search finds no posture, searches follow that start from other
/// knees, with the arms fixed, and from random angles of legs and trunk. A
/// fixed seed draws them. The last searches only require that the soles face +x
/// on average, and that the center of mass is halfway between its target and
/// the edge of the soles. Costs at most 2 s for 100 joints.
///
/// Arms that touch a body, or come nearer than ArmClearance(), move away with
/// SpreadArms(). Joints of profile.joints do not move then.
///
/// Writes robot->q_nominal and robot->can_stand. Throws std::invalid_argument
/// with the reason if no such posture is found: the smallest error of all
/// searches, and the joints at their limits.
/// pre: two feet, the left one first.
void StandUp(Robot* robot, const Profile& profile = {});

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
