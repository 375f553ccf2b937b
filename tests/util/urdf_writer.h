// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// Writes the URDF of a model. Reading it gives the same model up to rounding.
/// Each body is a link with its inertia. Each frame that is not a body's own is
/// a massless link on a fixed joint. Infinite limits are left out. Shapes are
/// not written, nor are armatures, which URDF does not have.
///
/// pre: each body has a frame of its own, at its origin.
std::string WriteUrdf(const RobotModel& model);

}  // namespace poise
