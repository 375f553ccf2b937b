// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// One way to step: corners in the plane, m, in any order.
struct StepOption {
  /// The corners of the sole that stays.
  std::vector<Eigen::Vector2d> stance;
  /// The corners of all places that the other sole can cover at its landing.
  std::vector<Eigen::Vector2d> landing;
};

/// Largest impulse from which a linear inverted pendulum recovers with one step
/// that lands at the time T after the push begins, for a push at the center of
/// mass. With omega = sqrt(g / h) and e = exp(-omega T), xi is caught if
///     xi(T) in K = hull(stance, landing),
/// and with the CoP in the stance sole S until then,
///     step_Ns = m omega d omega T_p / (1 - exp(-omega T_p)),
/// d being the distance from the center of mass to the edge of the set
/// e K + (1 - e) S along the push. Along one axis this is Koolen et al. 2012
/// with finite feet: d = r + (l + rho - r) e, r and rho being the distances to
/// the edges of the stance sole and of the landed sole, and l the reach.
///
/// @param com       center of mass, z above the soles, m.
/// @param u         horizontal direction of the push, of any length but 0.
/// @param duration  T_p of a constant force, s; 0 for an impulse.
/// @param T         time of the landing, s.
double ComputeStepYardstick(double mass, double gravity,
                            const Eigen::Vector3d& com,
                            const StepOption& option, const Eigen::Vector2d& u,
                            double duration, double T);

/// Returns the corners of the places of one sole's center, seen from the other
/// sole's center, m, at which both legs reach the ground from one base: from
/// the regions of both legs by inverse kinematics, with the base sunk by their
/// max_sink. The feet stay side by side or farther apart: they do not cross.
std::vector<Eigen::Vector2d> StepReach(const Robot& robot, int foot);

/// Time of the landing in the yardstick of a robot, s.
constexpr double kStepYardstickTime = 0.3;

/// Returns the yardstick of a robot in its nominal posture, with StepReach() of
/// the better of its two feet. Empty unless the robot has two feet. Costs about
/// 0.2 s.
std::optional<double> ComputeStepYardstick(const Robot& robot,
                                           const Eigen::Vector2d& u,
                                           double duration);

}  // namespace poise
