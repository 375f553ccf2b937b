// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/shift_height.h"

#include <algorithm>
#include <vector>

#include "poise/robot/control/posture/find_posture.h"
#include "poise/sim/observation.h"

namespace poise {
namespace {

// Returns, by joint, whether it is in no leg.
std::vector<bool> IsInNoLeg(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  std::vector<bool> is_in_no_leg(tree.num_joints(), true);
  for (const Foot& foot : robot.feet) {
    for (int b = foot.body; b > 0; b = tree.joints()[b - 1].parent) {
      is_in_no_leg[b - 1] = false;
    }
  }
  return is_in_no_leg;
}

}  // namespace

double SinkOfShift(const Robot& robot, int foot, const Eigen::Vector2d& G) {
  const double height = StandingHeight(robot);
  PostureGoal goal;
  // Arms that are raised, or a bent waist, would hold the height.
  goal.fixed = IsInNoLeg(robot);
  goal.support = SingleSupport{foot, 0, G, /*keeps_other=*/true, height};
  if (FindPosture(robot, goal).lack.empty()) return 0;
  goal.support->height.reset();
  const Posture lower = FindPosture(robot, goal);
  if (!lower.lack.empty()) return 0;
  Robot shifted = robot;
  shifted.q_nominal = lower.q;
  return std::max(0., height - StandingHeight(shifted));
}

}  // namespace poise
