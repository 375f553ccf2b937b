// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Finds the two feet of a biped, the left one first.
///
/// The feet are the two bodies that reach lowest in the configuration at rest,
/// with the base's z axis up. At rest, joints are at zero or at their nearest
/// limit. A sole is the flat underside of the body's collision shapes. If they
/// give no point, its visual shapes are used. Meshes are opened, see
/// MakeOutlines(). Candidate planes are normal to an axis of the shapes, to an axis of
/// the body, or to the vertical. They are at most 35 degrees from horizontal.
/// The plane with the largest area is chosen.
///
/// The forward direction is along the base's x axis, or along its y axis if the
/// feet are apart in x. Its sign is the side on which the soles reach further
/// from their ankles. If the soles are symmetric about the ankles, the knees
/// decide: by the direction of their range, and by their bend at rest.
///
/// If a foot has only meshes that cannot be read, and the leg of length L has
/// at least six motors, the sole is estimated:
///  - height: that of a link named `sole`, else of the foot's lowest link,
///    else 0.1 L below the ankle;
///  - length: from 0.07 L behind the ankle to 0.15 L in front of the ankle;
///  - width: 0.085 L, centered below the foot's center of mass.
/// All known feet are wider than this estimate, so a profile should give the
/// sole.
///
/// @param findings  if not null, receives a warning for each estimate.
///
/// Throws std::invalid_argument with the reason if two feet are not found.
std::vector<Foot> FindFeet(const RobotModel& model,
                           std::vector<Finding>* findings = nullptr);

}  // namespace poise
