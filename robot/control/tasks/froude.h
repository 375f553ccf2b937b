// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/task.h"

namespace poise {

/// Height of the center of mass above the soles for which the defaults of the
/// tasks were chosen, m: that of robot/models/humanoid.urdf.
constexpr double kTunedComHeight = 0.79241773219939693;

/// Scales the parameters of a task from kTunedComHeight to another height of
/// the center of mass, by Froude's rule: lengths scale with L = com_height /
/// kTunedComHeight, times with sqrt(L), so that kp [1/s2] scales with 1 / L and
/// kd [1/s] with 1 / sqrt(L). Robots that are alike then move alike, in units of
/// their own lengths and times. Angles, weights and coefficients of friction
/// stay. A robot within 0.1 % of kTunedComHeight keeps the defaults exactly.
///
/// MakeDefaultStack() derives momentum.k_orientation, and the task itself the
/// parameters of self_collision; these are not scaled again.
/// @pre com_height > 0.
void ScaleToHeight(double com_height, const Task& task);

}  // namespace poise
