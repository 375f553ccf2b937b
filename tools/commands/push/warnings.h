// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Returns the warnings among the findings about a file, in short form.
/// Warnings of one kind share a line, and there are at most six lines.
std::vector<std::string> WarningLines(const std::string& file,
                                      const std::vector<Finding>& findings);

/// Prints these lines on stderr. Adds the warnings of JudgeLegs() and those
/// about motors that are too weak for the standing posture.
/// @pre robot.can_stand.
void PrintWarnings(const std::string& file, const Robot& robot,
                   std::vector<Finding> findings);

/// Returns a warning if a budget leaves too little of the control period for
/// the rest of a tick, or else an empty string.
std::string BudgetWarning(const ControlSettings& control);

}  // namespace poise
