// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns warnings on the legs of a robot, for the user of its file:
///  - a leg with fewer than six joints, and the number of directions of its
///    sole that it does not control,
///  - leg joints with a velocity limit below kSlowestVelocity. Such limits are
///    often placeholders: balance needs faster legs.
///  - a foot that carries a chain of two joints or more: it is not the last
///    link.
/// A joint between the base and a foot belongs to the leg unless it moves
/// another foot as well. A joint that is coupled to another counts.
std::vector<Finding> JudgeLegs(const Robot& robot);

}  // namespace poise
