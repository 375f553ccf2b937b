// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/robot.h"

namespace poise {

/// Differences between the Bullet plant of a robot and our own dynamics, each
/// relative to its own scale. M and g are ours, M' and g' those of Bullet.
struct Parity {
  double mass;            ///< Relative to the total mass.
  double center_of_mass;  ///< Relative to the robot's largest radius of
                          ///< gyration about the base's origin.
  double inertia;         ///< Largest |M - M'|_ij / sqrt(M_ii M_jj).
  double gravity;         ///< Largest |g - g'|_i / max_j |g_j|.

  /// Returns the largest of the four, or NaN if one is NaN.
  double worst() const;
};

/// Measures M' and g' of the Bullet plant and compares them with M and g. The
/// plant is at rest, with its joints as near zero as their limits allow. Its
/// accelerations under one unit force after the other, minus the acceleration
/// under gravity alone, are the columns of M'^-1.
/// Under gravity alone its acceleration v̇ gives g' = -M' v̇.
///
/// Throws std::invalid_argument if Bullet cannot represent the robot.
///
/// @param plant_of  the robot to make the plant from. Only tests pass another
///                  robot than `robot`.
Parity CompareWithBullet(const Robot& robot, const Robot& plant_of);

}  // namespace poise
