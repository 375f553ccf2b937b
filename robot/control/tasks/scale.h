// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"

namespace poise {

/// Scale of rows in forces and moments, N (or N m): a quarter of the robot's
/// weight. Divided by the scale, the rows are about 1. A tree without mass or
/// gravity has the scale 1.
inline double ForceScale(const Tree& tree) {
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  return weight > 0 ? weight / 4 : 1;
}

}  // namespace poise
