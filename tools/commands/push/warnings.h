// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/finding.h"

namespace poise {

/// The warnings among findings about a file, for people who asked for something
/// else: those of one kind in one line, and no more than a few lines.
std::vector<std::string> WarningLines(const std::string& file,
                                      const std::vector<Finding>& findings);

}  // namespace poise
