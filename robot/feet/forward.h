// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/feet/feet_hints.h"
#include "poise/robot/feet/legs.h"
#include "poise/robot/feet/sole.h"
#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns "+x", "-x", "+y", "-y", "+z" or "-z" if a vector is within 0.7 rad
/// of this axis, else "".
std::string NameOfAxis(const Eigen::Vector3d& v);

/// Returns the axis with a name as of NameOfAxis(), or nothing if no axis has
/// this name.
std::optional<Eigen::Vector3d> AxisOfName(const std::string& name);

/// Returns the name of the root link's axis along which the robot faces, or ""
/// if it faces along none. The feet decide: their x axes in the configuration
/// at rest.
/// @pre The robot has two feet.
std::string ForwardAxis(const Robot& robot);

/// Returns 1 if the names of the links and joints of two legs say that the
/// first leg is on the left, -1 if they say that the second one is, see
/// CompareSides(). Returns 0 if they do not say it, or contradict each other.
/// @param contradict  receives whether the names contradict each other.
int LeftByNames(const RobotModel& model, const Legs& legs, bool* contradict);

/// The direction in which a biped faces, and its left foot.
struct Facing {
  Eigen::Vector3d forward_W;  ///< Along the x or the y axis of the world.
  int left;                   ///< Index of the left foot in Legs::feet, 0 or 1.
};

/// Finds the direction in which a biped faces. It is across the line between
/// the feet. The sign is that of the first of these that decides:
///  1. the hints,
///  2. the names of the links and joints of both legs, see CompareSides(),
///  3. the soles, if they reach further from the ankles on one side, by 5 % of
///     their length,
///  4. REP 103: the root link's x axis points forward, if it is across,
///  5. the knees, if their range and their bend at rest have one direction, by
///     0.2 rad. Some robots have the knees of a bird, so REP 103 comes first.
///
/// @param soles     by foot; a sole without points does not decide.
/// @param X_WB      the poses of the bodies, with the legs along the world's z.
/// @param findings  if not null, receives a warning if names, soles, knees or
///                  REP 103 contradict the result, or if only REP 103 or
///                  nothing decides.
Facing FindFacing(const RobotModel& model, const Legs& legs,
                  const std::array<Sole, 2>& soles,
                  const std::vector<Pose>& X_WB, const FeetHints& hints,
                  std::vector<Finding>* findings);

}  // namespace poise
