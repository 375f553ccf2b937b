// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/push_bound.h"

namespace poise {

std::optional<Yardstick> BoundOfPush(const Robot& robot,
                                     const Eigen::VectorXd& q, const Push& push,
                                     const std::vector<bool>& down) {
  if (push.frame != PushFrame::kWorld || push.force.head<2>().isZero()) {
    return std::nullopt;
  }
  const PushOnRobot aimed(robot, push);
  return ComputeYardstick(robot, q, push.force.head<2>(), push.duration,
                          aimed.body(), aimed.p_BoQ_B(), down);
}

void ApplyFraction(const Robot& robot, const Eigen::VectorXd& q,
                   const std::vector<bool>& down, Push* push) {
  const double time = ProfileIntegral(*push);
  if (!push->impulse_fraction || !(time > 0)) return;
  const auto bound = BoundOfPush(robot, q, *push, down);
  if (!bound) return;
  const double impulse = *push->impulse_fraction * bound->lipm_height_Ns;
  push->force *= impulse / time / push->force.norm();
}

}  // namespace poise
