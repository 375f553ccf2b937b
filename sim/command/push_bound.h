// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/push.h"
#include "poise/sim/yardstick.h"

namespace poise {

/// Returns the pendulum's bound in the direction of a push, for a robot in the
/// configuration q. `down` marks the feet on the ground; empty means all. Empty
/// if the push has no horizontal direction in the world.
std::optional<Yardstick> BoundOfPush(const Robot& robot,
                                     const Eigen::VectorXd& q, const Push& push,
                                     const std::vector<bool>& down = {});

/// Sets the force of a push so that its impulse is Push::impulse_fraction of
/// lipm_height_Ns, as BoundOfPush() returns it. Changes nothing if the push has
/// no such fraction.
void ApplyFraction(const Robot& robot, const Eigen::VectorXd& q,
                   const std::vector<bool>& down, Push* push);

}  // namespace poise
