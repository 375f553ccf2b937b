// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/shift_height.h"

#include <algorithm>

#include "poise/robot/control/posture/find_posture.h"
#include "poise/robot/control/posture/one_foot.h"
#include "poise/sim/observation.h"

namespace poise {
double SinkOfShift(const Robot& robot, int foot, const Eigen::Vector2d& G,
                   double lean) {
  const double height = StandingHeight(robot);
  PostureGoal goal;
  // Arms that are raised, or a bent waist, would hold the height.
  goal.fixed = IsInNoLeg(robot);
  goal.support = SingleSupport{foot, 0, G, /*keeps_other=*/true, height, lean};
  if (FindPosture(robot, goal).lack.empty()) return 0;
  goal.support->height.reset();
  const Posture lower = FindPosture(robot, goal);
  if (!lower.lack.empty()) return 0;
  Robot shifted = robot;
  shifted.q_nominal = lower.q;
  return std::max(0., height - StandingHeight(shifted));
}

}  // namespace poise
