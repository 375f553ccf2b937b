// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/nominal_tick.h"

#include <Eigen/Core>

namespace poise {

Tick NominalTick(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv()), &tick);
  return tick;
}

}  // namespace poise
