// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Returns which joints belong to neither legs nor trunk: they carry no foot,
/// and less than 15 % of the mass. A joint of a mimic coupling is not among
/// them, because the joint coupled to it may move.
std::vector<bool> FindArms(const Robot& robot);

/// Returns the smallest distance that arms keep from other bodies, m: 20 mm,
/// but at most 3 % of the length of the longest chain of joints.
double ArmClearance(const RobotModel& model);

/// Moves arms away from the body and from each other, until the capsules of
/// their bodies have a distance of ArmClearance(). For each arm, one joint that
/// turns about the forward axis moves as little as possible. If this is not
/// enough, the joints that increase the distance most move, up to three of
/// them. An arm that has enough distance does not move.
///
/// @param arms   from FindArms().
/// @param fixed  joints that must not move, by joint.
/// @param robot  robot->q_nominal is the posture. Only joints of arms change.
/// @return true if a joint was moved. Costs about 50 ms for 50 joints.
bool SpreadArms(const std::vector<bool>& arms, const std::vector<bool>& fixed,
                Robot* robot);

}  // namespace poise
