// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <optional>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Height of the center of mass above the soles for which the defaults of the
/// tasks were chosen, m: that of robot/models/humanoid.urdf.
constexpr double kTunedComHeight = 0.79241773219939693;

/// Mass of robot/models/humanoid.urdf, kg.
constexpr double kTunedMass = 38.66;

/// The size of a robot, over that of robot/models/humanoid.urdf. A quantity
/// with a unit is multiplied by these ratios: by Froude's rule, robots that are
/// alike then move alike. Accelerations do not depend on the size.
struct FroudeScale {
  double length = 1;
  double mass = 1;

  double time() const { return std::sqrt(length); }
  double speed() const { return std::sqrt(length); }
  /// The ratio of moments of inertia.
  double inertia() const { return mass * length * length; }
};

/// Returns the scale of a robot in its nominal posture, from its mass and the
/// height of its center of mass. A ratio within 0.1 % of 1 is 1. A robot
/// without feet, or without a posture above its soles, has the length 1.
FroudeScale MakeFroudeScale(const Robot& robot);

/// Returns the height of the center of mass above the mean of the soles in the
/// nominal posture, m. Empty without feet or a nominal posture.
std::optional<double> NominalComHeight(const Robot& robot);

/// Scales the parameters of a task from kTunedComHeight to another height of
/// the center of mass, by Froude's rule: lengths scale with L = com_height /
/// kTunedComHeight, times with sqrt(L), so that kp [1/s2] scales with 1 / L and
/// kd [1/s] with 1 / sqrt(L). Robots that are alike then move alike, in units
/// of their own lengths and times. Angles, weights and coefficients of friction
/// stay, but weights of angular momentum, which has a length in its unit, scale
/// with 1 / L^2. A robot within 0.1 % of kTunedComHeight keeps the defaults
/// exactly.
///
/// MakeDefaultStack() derives momentum.k_orientation, and the task itself the
/// parameters of self_collision; these are not scaled again.
/// @pre com_height > 0.
void ScaleToHeight(double com_height, const Task& task);

}  // namespace poise
