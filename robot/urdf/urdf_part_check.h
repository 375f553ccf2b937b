// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf_xml.h"

namespace poise {

/// Checks the `<inertial>` of a link, if it has one.
/// @pre here and below: the element went through PruneUrdf() unrejected.
void CheckInertial(const tinyxml2::XMLElement& link, const Critic& critic);

/// Checks the `<origin>` of a joint or a shape for units that are not m and rad.
void CheckOrigin(const tinyxml2::XMLElement& element, const Critic& critic);

/// Checks the `<axis>` of a moving joint.
void CheckAxis(const tinyxml2::XMLElement& joint, const Critic& critic);

/// Reads and checks the limits of a moving joint. A negative effort is rejected.
/// Any other limit that is absent, infinite or impossible (lower above upper, a
/// velocity that is not positive) becomes infinite, with a warning where the
/// file should have one.
JointLimits CheckLimits(const tinyxml2::XMLElement& joint,
                        const Critic& critic);

}  // namespace poise
