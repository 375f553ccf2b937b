// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "poise/dynamics/tick.h"

namespace poise {

/// Divergent component of motion of a robot, with a share of its angular
/// momentum k about G given back: xi = p_G + (v_G + share k x z / (m h)) / w,
/// in the plane. m is the mass, h the height of G above the ground.
inline Eigen::Vector2d ComputeDcm(const Tick& tick, double mass, double height,
                                  double omega, double share) {
  const Eigen::Vector2d k_cross_z(tick.L_G[1], -tick.L_G[0]);
  return tick.p_WG.head<2>() +
         (tick.v_WG.head<2>() + share / (mass * height) * k_cross_z) / omega;
}

/// Divergent component of motion xi = c + v / w of a linear inverted pendulum
/// with frequency w and its center of mass at c: xi' = w (xi - p) with the CoP
/// at p. Also called the instantaneous capture point.
///
/// xi after a time T with a constant CoP:
///     xi(T) = p + (xi - p) exp(w T).
inline Eigen::Vector2d PredictDcm(const Eigen::Vector2d& xi,
                                  const Eigen::Vector2d& p, double omega,
                                  double T) {
  return p + (xi - p) * std::exp(omega * T);
}

/// The center of mass after a time T with a constant CoP p, from its position c
/// and velocity v:
///     c(T) = p + (c - p) cosh(w T) + v / w sinh(w T).
inline Eigen::Vector2d PredictCom(const Eigen::Vector2d& c,
                                  const Eigen::Vector2d& v,
                                  const Eigen::Vector2d& p, double omega,
                                  double T) {
  return p + (c - p) * std::cosh(omega * T) + v / omega * std::sinh(omega * T);
}

/// The constant CoP that moves xi to xi_T in a time T > 0.
inline Eigen::Vector2d CopForDcm(const Eigen::Vector2d& xi,
                                 const Eigen::Vector2d& xi_T, double omega,
                                 double T) {
  const double e = std::exp(omega * T);
  return (xi * e - xi_T) / (e - 1);
}

}  // namespace poise
