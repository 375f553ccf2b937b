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

bool ApplyFraction(const Robot& robot, const Eigen::VectorXd& q,
                   const std::vector<bool>& down,
                   const Eigen::Vector3d& direction, Push* push) {
  if (!push->impulse_fraction) return true;
  push->force = direction;
  const double time = ProfileIntegral(*push);
  const auto bound = BoundOfPush(robot, q, *push, down);
  if (!(time > 0)) return true;
  const double most = bound ? bound->lipm_height_Ns : 0;
  const double impulse = *push->impulse_fraction * most;
  push->force *= impulse / time / push->force.norm();
  return impulse > 0 || *push->impulse_fraction == 0;
}

bool HasBegun(const Push& push, double time, double dt) {
  constexpr double kRounding = 1e-9;  // A sum of many periods rounds, s.
  return push.start < time + dt - kRounding;
}

}  // namespace poise
