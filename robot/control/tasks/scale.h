// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "dynamics/tree.h"

namespace poise {

/// What rows in forces and moments are divided by, so that they are about 1: a
/// quarter of the robot's weight, N (or N m).
inline double ForceScale(const Tree& tree) {
  constexpr double kStandardGravity = 9.81;
  return tree.total_mass() > 0 ? tree.total_mass() * kStandardGravity / 4 : 1;
}

}  // namespace poise
