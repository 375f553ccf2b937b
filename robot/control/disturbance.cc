// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/disturbance.h"

#include <algorithm>

namespace poise {
namespace {

constexpr double kLargestLift = 1.6;   // Clamp along z, m/s2.
constexpr double kLargestShift = 0.5;  // Clamp in the plane, m/s2.

// Below this speed of the center of mass, the robot counts as standing, m/s. It
// holds for robot/models/humanoid.urdf.
constexpr double kStanding = 0.02;

}  // namespace

Disturbance::Disturbance(const FroudeScale& scale)
    : standing_(kStanding * scale.speed()) {}

void Disturbance::Update(double dt, const ComGains& gains,
                         const Reference& reference,
                         const Tick& tick) noexcept {
  const bool stands = reference.v_WG.isZero() && tick.v_WG.norm() < standing_;
  const double decay = gains.kp > 0 ? gains.kd / gains.kp : 0;
  const Eigen::Vector3d e_W =
      reference.p_WG - tick.p_WG + decay * (reference.v_WG - tick.v_WG);
  auto level = c_W_.head<2>();
  if (stands) level += dt * gains.ki * e_W.head<2>();
  level *= kLargestShift / std::max(level.norm(), kLargestShift);
  if (gains.ki == 0) level.setZero();
  double& up = c_W_.z();
  up = std::clamp(up + dt * gains.ki_height * e_W.z(), -kLargestLift,
                  kLargestLift);
  if (gains.ki_height == 0) up = 0;
}

}  // namespace poise
