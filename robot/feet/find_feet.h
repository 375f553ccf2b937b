// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "robot/finding.h"
#include "robot/robot.h"

namespace poise {

/// Finds the two feet of a biped, left one first.
///
/// The joints at zero (or at their nearest limit) and the base's z axis up, the
/// feet are the two bodies that reach lowest. A sole is the flat underside of
/// the body's collision boxes, cylinders and spheres (visual ones where it has
/// no other): of all planes normal to an axis of the shapes, of the body, or to
/// the vertical, within 35 degrees of level, the one with the largest area.
/// Forward is along the base's x axis (along y, where the feet stand apart in
/// x), to the side on which the soles reach further from their ankles or, where
/// they do not say, to which the knees bend, or are bent at rest.
///
/// Where the file has only meshes, which are not opened, the sole of a leg with
/// six motors or more is estimated: on the level of a link named `sole`, or of
/// the foot's lowest link, or a tenth of the leg's length L below the ankle;
/// from 0.07 L behind the ankle to 0.15 L before it, 0.12 L wide, smaller than
/// most are, sideways below the foot's center of mass. It is better given by a
/// profile.
///
/// @param findings  where not null, a warning is added for each estimate.
///
/// Throws std::invalid_argument with the reason where there are no such two.
std::vector<Foot> FindFeet(const RobotModel& model,
                           std::vector<Finding>* findings = nullptr);

}  // namespace poise
