// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/feet/feet_hints.h"
#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Finds the two feet of a biped, the left one first, in the configuration at
/// rest: joints are at zero or at their nearest limit.
///
/// A foot is the last moved body of a leg. FindLegs() describes how legs are
/// told from arms, and how the vertical is found. A leg must have four motors,
/// and gets a warning if it has fewer than five. FindFacing() describes how
/// forward is told from backward, and left from right.
///
/// A sole is the flat underside of the body's collision shapes. If they give no
/// point, its visual shapes are used. Meshes are opened, see MakeOutlines().
/// FindSole() describes how the plane of the sole is chosen. A sole shorter
/// than a tenth of the leg, or longer than the leg, gets a warning.
///
/// If a foot has only meshes that cannot be read, the sole is estimated from
/// the height L of the hip above the foot's origin:
///  - height: that of a link named `sole`, else of the foot's lowest link,
///    else 0.1 L below the ankle;
///  - length: from 0.07 L behind the ankle to 0.15 L in front of the ankle;
///  - width: 0.085 L, centered below the foot's center of mass.
/// All known feet are wider than this estimate, so a profile should give the
/// sole.
///
/// @param findings  if not null, receives the warnings.
/// @param hints     facts that a profile gives.
///
/// Throws std::invalid_argument with the reason if two feet are not found, in
/// some cases as NoFeet.
std::vector<Foot> FindFeet(const RobotModel& model,
                           std::vector<Finding>* findings = nullptr,
                           const FeetHints& hints = {});

}  // namespace poise
