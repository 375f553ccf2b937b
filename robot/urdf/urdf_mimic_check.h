// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf_xml.h"

namespace poise {

/// Checks each `<mimic>` of a moving joint:
/// - rejects it if its source does not exist or is the joint itself;
/// - rejects a cycle of mimic joints;
/// - warns if the source is a fixed joint;
/// - notes if the range of the source moves the joint out of its own limits.
///
/// @param names   the names of the joints, in the file's order.
/// @param limits  the limits of the moving joints, by name.
void CheckMimics(const std::vector<std::string>& names, const Elements& joints,
                 const std::map<std::string, JointLimits>& limits,
                 const Critic& critic);

}  // namespace poise
