// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// A text of a profile, and its line in the file.
struct TextValue {
  std::string text;  ///< Empty if the profile does not give it.
  int line = 0;
};

/// The keys of a profile that say which way the robot faces.
struct Sides {
  TextValue forward;  ///< "+x", "-x", "+y", "-y", "+z" or "-z".
  TextValue left;     ///< Name of a link of the left foot.
  TextValue right;    ///< Name of a link of the right foot.
};

/// Finds the feet as FindFeet() does, with the feet and the forward direction
/// that a profile gives.
///
/// @param file  the name of the profile, for messages.
///
/// Throws Refusal with file and line if a link is unknown, or if the two links
/// are not the feet of two legs. Throws std::invalid_argument as FindFeet().
std::vector<Foot> FindFeetOf(const RobotModel& model, const Sides& sides,
                             const std::string& file,
                             std::vector<Finding>* findings);

/// Throws Refusal with file and line if the feet of a robot contradict the
/// profile's `forward`, `left` or `right`.
///
/// @param gives_feet  whether the profile gives the soles under `feet`.
/// @pre The robot has two feet, the left one first.
void CheckSides(const Robot& robot, const Sides& sides, const std::string& file,
                bool gives_feet);

}  // namespace poise
