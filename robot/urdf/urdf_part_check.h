// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf_xml.h"

namespace poise {

/// Checks the `<inertial>` of a link, if the link has one.
/// @pre For all functions of this file: PruneUrdf() accepted the element.
void CheckInertial(const tinyxml2::XMLElement& link, const Critic& critic);

/// Checks the `<origin>` of a joint, a shape or an inertial. Warns if its
/// numbers seem to be in other units than m and rad.
void CheckOrigin(const tinyxml2::XMLElement& element, const Critic& critic);

/// Checks the `<axis>` of a moving joint.
void CheckAxis(const tinyxml2::XMLElement& joint, const Critic& critic);

/// Reads and checks the limits of a moving joint. A negative effort is
/// rejected. Any other limit that is absent, infinite or invalid becomes
/// infinite. Invalid are lower above upper, and a velocity that is not
/// positive. The finding is a warning if the joint's type requires the limit.
JointLimits CheckLimits(const tinyxml2::XMLElement& joint,
                        const Critic& critic);

}  // namespace poise
