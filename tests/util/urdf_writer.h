// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// The URDF of a model, so that reading it gives the model again to rounding:
/// each body is a link with its inertia, each frame that is no body's own a
/// massless link on a fixed joint. Infinite limits are left out. Shapes and
/// armature, which URDF does not know, are not written.
///
/// pre: each body has a frame of its own, at its origin.
std::string WriteUrdf(const RobotModel& model);

}  // namespace poise
