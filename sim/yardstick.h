// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Largest impulses from which a linear inverted pendulum on the same feet
/// recovers. They are the yardstick for pushes that a robot recovers from
/// without a step.
struct Yardstick {
  double lipm_Ns;         ///< For a push at the center of mass.
  double lipm_height_Ns;  ///< For a push at z_p that does not turn it.
};

/// Computes the yardstick. With omega = sqrt(g / h), h the height of the center
/// of mass above the soles, and rho the distance from the projection of the
/// center of mass to the edge of the support polygon along the push u,
///     lipm_Ns = m omega rho omega T / (1 - exp(-omega T)),
///     lipm_height_Ns = lipm_Ns h / z_p.
///
/// @param mass      m, kg.
/// @param gravity   g > 0, m/s2.
/// @param com       center of mass, z > 0 above the soles, m.
/// @param soles     corners of all soles on the ground, m, in any order.
/// @param u         horizontal direction of the push, of any length but 0.
/// @param duration  T of a constant force, s; 0 for an impulse.
/// @param push_height  z_p > 0, height of the force above the soles, m.
///
/// Both are 0 if the center of mass lies outside the convex hull of the soles.
/// Source: Koolen et al., "Capturability-based analysis ...", IJRR 31(9), 2012,
/// with the push's force added to the pendulum's equation of motion.
Yardstick ComputeYardstick(double mass, double gravity,
                           const Eigen::Vector3d& com,
                           const std::vector<Eigen::Vector2d>& soles,
                           const Eigen::Vector2d& u, double duration,
                           double push_height);

/// Returns the yardstick of a robot in the configuration q, pushed at the point
/// Q of a body. Heights are above its lowest sole. `down` marks the feet on the
/// ground; empty means all. Returns nothing unless Q and the center of mass are
/// above the lowest sole: no pendulum then has a bound.
std::optional<Yardstick> ComputeYardstick(const Robot& robot,
                                          const Eigen::VectorXd& q,
                                          const Eigen::Vector2d& u,
                                          double duration, int body,
                                          const Eigen::Vector3d& p_BoQ_B,
                                          const std::vector<bool>& down = {});

}  // namespace poise
