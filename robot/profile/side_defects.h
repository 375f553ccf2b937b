// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/sides.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns warnings on the feet of a robot:
///  - the line between the soles, at rest, is more than 15 degrees off the
///    soles' y axis, and the profile does not give `forward`;
///  - the profile gives the feet or `forward`, and the names of the legs say
///    that left and right are swapped, see CompareSides();
///  - the profile gives the feet, and most names of a leg name parts of an arm,
///    see LegOrArm().
///
/// @param sides       what the profile says.
/// @param gives_feet  whether the profile gives the soles under `feet`.
/// @pre The robot has two feet, the left one first.
std::vector<Finding> FindSideDefects(const Robot& robot, const Sides& sides,
                                     bool gives_feet);

}  // namespace poise
