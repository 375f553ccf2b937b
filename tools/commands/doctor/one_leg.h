// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Checks for each foot if the robot can stand on this foot alone, at rest. The
/// other sole is raised by 3 % of the height of the center of mass. The center
/// of mass is above the middle of the sole or, if this is not possible, above
/// the point of the sole that is nearest to the ankle.
///
/// Returns a warning for each foot on which the robot cannot stand: the sole is
/// narrower than 4 % of the height of the center of mass; the center of mass
/// does not come over the sole while both soles lie flat, as before the other
/// foot is lifted; the joints do not reach the posture; or a motor is too weak
/// for it.
///
/// Costs at most six searches of FindPosture().
/// @pre robot.can_stand.
std::vector<Finding> FindOneLegDefects(const Robot& robot);

}  // namespace poise
