// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "robot/robot.h"
#include "robot/urdf/urdf_xml.h"

namespace poise {

/// Checks every `<mimic>` of moving joints: that it names another one that
/// moves, that whoever follows whom ends at a joint that follows nobody, and
/// that it leads no joint out of its own limits.
/// @param names   of the joints, in the file's order.
/// @param limits  of moving joints.
void CheckMimics(const std::vector<std::string>& names, const Elements& joints,
                 const std::map<std::string, JointLimits>& limits,
                 const Critic& critic);

}  // namespace poise
