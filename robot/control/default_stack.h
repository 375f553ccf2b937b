// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "robot/control/stack.h"
#include "robot/robot.h"

namespace poise {

/// Every task of this folder, in the ranks and switched as Controller says.
Stack MakeDefaultStack(const Robot& robot);

}  // namespace poise
