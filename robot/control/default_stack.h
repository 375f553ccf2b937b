// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns a stack with every task of tasks/, on the levels and switched on or
/// off as in the table of Controller.
///
/// @param frames  links with a task frame.NAME. The i-th one uses
///                Tick::frames[feet + i] and Reference::frames[i]; feet is the
///                number of feet.
Stack MakeDefaultStack(const Robot& robot,
                       const std::vector<std::string>& frames);

}  // namespace poise
