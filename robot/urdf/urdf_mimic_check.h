// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf_xml.h"

namespace poise {

/// Checks each `<mimic>` of a moving joint. Its source must be another moving
/// joint, each chain of mimics must end at a joint without `<mimic>`, and the
/// source should lead no joint out of its limits.
/// @param names   the names of the joints, in the file's order.
/// @param limits  the limits of moving joints, by name.
void CheckMimics(const std::vector<std::string>& names, const Elements& joints,
                 const std::map<std::string, JointLimits>& limits,
                 const Critic& critic);

}  // namespace poise
