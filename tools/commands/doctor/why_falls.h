// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>

#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"

namespace poise {

/// Simulates the beginning of the scenario `stand`, for `duration` s, with the
/// default task set, or with the tasks of a profile. Returns "" if the robot
/// stays up, by the rules of Judge, or the reason why it falls, in words.
///
/// The simulation ends after `longest` s of processor time or 1.6 times as long
/// in real time at the latest. Returns nothing if the robot has not fallen
/// until then.
/// @pre robot.can_stand.
std::optional<std::string> WhyFalls(const Robot& robot, const Profile& profile,
                                    double duration, double longest);

}  // namespace poise
