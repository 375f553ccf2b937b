// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/urdf/urdf.h"

namespace poise {

/// Returns our humanoid's URDF file with `count` more fingers on each hand.
/// Each has five joints, and the masses and limits of the hand's own fingers.
UrdfDocument AddFingers(int count);

}  // namespace poise
