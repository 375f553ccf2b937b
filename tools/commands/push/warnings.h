// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// The warnings among findings about a file, for people who asked for something
/// else: those of one kind in one line, and no more than a few lines.
std::vector<std::string> WarningLines(const std::string& file,
                                      const std::vector<Finding>& findings);

/// Prints these lines on stderr, with the motors that are too weak to hold the
/// robot up. @pre robot.can_stand.
void PrintWarnings(const std::string& file, const Robot& robot,
                   std::vector<Finding> findings);

}  // namespace poise
