// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/hanging_joints.h"

namespace poise {

std::vector<bool> FindHangingJoints(const RobotModel& model) {
  const Tree& tree = model.tree;
  std::vector<bool> hangs(tree.num_joints(), true);
  for (int j = tree.num_joints() - 1; j >= 0; --j) {
    if (model.limits[j].effort == 0 && hangs[j]) continue;
    hangs[j] = false;
    const int parent = tree.joints()[j].parent;
    if (parent > 0) hangs[parent - 1] = false;
  }
  return hangs;
}

}  // namespace poise
