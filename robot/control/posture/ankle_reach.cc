// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/ankle_reach.h"

#include <cmath>
#include <limits>

namespace poise {

double AnkleReach(const Robot& robot, int ankle) {
  constexpr double kShare = 0.5;
  const double effort = robot.model.limits[ankle].effort;
  if (!(effort >= 0 && std::isfinite(effort))) {
    return std::numeric_limits<double>::infinity();
  }
  const Tree& tree = robot.model.tree;
  return kShare * effort / (tree.total_mass() * tree.gravity_W().norm());
}

}  // namespace poise
