// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/robot/robot.h"

namespace poise {

/// Makes a stack of every task of tasks/. Levels and switches are those in the
/// documentation of Controller.
///
/// @param frames  links that get a task frame.NAME, the i-th by
///                Tick::frames[feet + i] and Reference::frames[i].
Stack MakeDefaultStack(const Robot& robot,
                       const std::vector<std::string>& frames);

}  // namespace poise
