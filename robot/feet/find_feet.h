// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Finds the two feet of a biped, the left one first.
///
/// The feet are the two bodies that reach lowest when the joints are at zero (or
/// at their nearest limit) and the base's z axis points up. A sole is the flat
/// underside of the body's collision boxes, cylinders and spheres, or of its
/// visual ones if it has no other. Candidate planes are normal to an axis of the
/// shapes, of the body, or to the vertical, and within 35 degrees of level. The
/// plane with the largest area wins.
///
/// Forward is along the base's x axis, or along y if the feet stand apart in x.
/// The sign is the side on which the soles reach further from their ankles. If
/// they reach equally far, it is the side to which the knees bend, or are bent at
/// rest.
///
/// Meshes are not opened. If a foot has no other shape, and the leg of length L
/// has six motors or more, the sole is estimated:
///  - height: that of a link named `sole`, or of the foot's lowest link, or
///    0.1 L below the ankle;
///  - length: from 0.07 L behind the ankle to 0.15 L before it;
///  - width: 0.12 L, with its middle below the foot's center of mass.
/// Most feet are larger than this estimate. A profile should give the sole.
///
/// @param findings  if not null, receives a warning for each estimate.
///
/// Throws std::invalid_argument with the reason if there are no two such feet.
std::vector<Foot> FindFeet(const RobotModel& model,
                           std::vector<Finding>* findings = nullptr);

}  // namespace poise
