// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/robot.h"

namespace poise {

/// How far the Bullet plant of a robot is from our own dynamics, each relative
/// to its own scale.
struct Parity {
  double mass;            ///< Of the total mass.
  double center_of_mass;  ///< Of its distance from the base's origin, or 1 m.
  double inertia;         ///< |M - M'|_ij over sqrt(M_ii M_jj), the largest.
  double gravity;         ///< |g - g'|_i over |g|, the largest.

  double worst() const;
};

/// Asks the plant for its accelerations under unit forces, at rest with its
/// joints as near zero as their limits let them, which gives it away: M' is the
/// inverse of what it answers, and g' = -M' v̇ under gravity alone.
///
/// Throws std::invalid_argument where Bullet cannot represent the robot.
///
/// @param plant_of  what to make the plant from: the robot itself, but in a test.
Parity CompareWithBullet(const Robot& robot, const Robot& plant_of);

}  // namespace poise
