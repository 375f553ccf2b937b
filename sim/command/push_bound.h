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
/// if the push has no horizontal direction in the world, or as
/// ComputeYardstick(): the push or the center of mass is below the soles.
std::optional<Yardstick> BoundOfPush(const Robot& robot,
                                     const Eigen::VectorXd& q, const Push& push,
                                     const std::vector<bool>& down = {});

/// Sets the force of a push along `direction` so that its impulse is
/// Push::impulse_fraction of lipm_height_Ns, as BoundOfPush() returns it.
/// Changes nothing if the push has no such fraction.
///
/// @param direction  force as the scenario gives it, in the world, of any
///                   length but 0.
/// @return false if the fraction is positive and there is no bound above 0,
///         because the center of mass is not above the soles, or the push is
///         below the soles. The force is then 0.
/// @pre The duration of a push with a fraction is positive.
[[nodiscard]] bool ApplyFraction(const Robot& robot, const Eigen::VectorXd& q,
                                 const std::vector<bool>& down,
                                 const Eigen::Vector3d& direction, Push* push);

/// Returns whether a push has begun before the end of the control tick [time,
/// time + dt], s. A push that begins with the next tick, up to rounding, has
/// not.
bool HasBegun(const Push& push, double time, double dt);

}  // namespace poise
