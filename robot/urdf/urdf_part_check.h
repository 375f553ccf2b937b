// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include "robot/robot.h"
#include "robot/urdf/urdf_xml.h"

namespace poise {

/// Checks the `<inertial>` of a link, if it has one.
/// @pre here and below: the element went through PruneUrdf() unrejected.
void CheckInertial(const tinyxml2::XMLElement& link, const Critic& critic);

/// Checks the `<origin>` of a joint or a shape for units that are not m and rad.
void CheckOrigin(const tinyxml2::XMLElement& element, const Critic& critic);

/// Checks the `<axis>` of a moving joint.
void CheckAxis(const tinyxml2::XMLElement& joint, const Critic& critic);

/// The limits of a moving joint. What is absent, infinite, or cannot be a limit
/// (lower above upper, a velocity of zero, a negative effort) is infinite, with
/// a warning where the file should have one.
JointLimits CheckLimits(const tinyxml2::XMLElement& joint,
                        const Critic& critic);

}  // namespace poise
