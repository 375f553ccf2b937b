// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "robot/robot.h"

namespace poise {

/// Finds the two feet of a biped, left one first, from its collision shapes.
///
/// The joints at zero (or at their nearest limit) and the base's z axis up, the
/// feet are the two bodies, one on each side, that reach lowest. The sole is
/// the flat underside of their boxes, cylinders and spheres: of all planes that
/// hold three of their corners and have the others above, the one with the
/// largest area, within 35 degrees of level. Forward is along the base's x
/// axis, to the side on which the soles reach further from their ankles.
///
/// Throws std::invalid_argument with the reason where there are no such two.
std::vector<Foot> FindFeet(const RobotModel& model);

}  // namespace poise
