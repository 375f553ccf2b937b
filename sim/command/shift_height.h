// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/robot.h"

namespace poise {

/// Returns by how much the center of mass has to sink for a shift to one foot,
/// m. Both soles, and all joints outside the legs, stay where they are in
/// robot.q_nominal. The result is 0 if a posture at the nominal height exists,
/// and if none exists at any height. If the feet are far apart or the knees
/// nearly straight, the other leg is too short for the nominal height.
/// @param foot  index into robot.feet.
/// @param G     target of the center of mass in the sole's frame, m.
/// @param lean  of the base to the left, rad, see SingleSupport.
/// @pre The robot has two feet.
/// Costs one or two searches of a posture, see FindPosture().
double SinkOfShift(const Robot& robot, int foot, const Eigen::Vector2d& G,
                   double lean = 0);

}  // namespace poise
