// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// Warnings where there are no contact forces with which the motors hold the
/// robot up as it stands: each motor that is too weak, or the whole robot.
/// @pre robot.can_stand.
std::vector<Finding> FindWeakness(const Robot& robot);

}  // namespace poise
