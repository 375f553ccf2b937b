// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/robot.h"

namespace poise {

/// Loads Poise's humanoid with its profile.
Robot LoadHumanoid();

}  // namespace poise
