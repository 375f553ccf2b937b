// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tick.h"

namespace poise {

/// Estimates an external push from its effect: the part of the acceleration of
/// the center of mass that the controller did not predict.
class PushEstimate {
 public:
  /// The thresholds of the estimate.
  struct Settings {
    /// A push is noticed above this acceleration of the center of mass, m/s2.
    double noticed = 1.6;
    /// Duration that a push is expected to have from its start, s.
    double expected = 0.1;
    /// A push is over after this long below `noticed`, s.
    double over_after = 0.05;
  };

  /// @param mass  of the robot, kg.
  PushEstimate(double mass, const Settings& settings)
      : mass_(mass), settings_(settings) {}

  void Reset() noexcept;

  /// Updates the estimate.
  /// @param unmodelled_vdot  see UnmodelledAcceleration.
  /// Does not allocate.
  void Update(double dt, const Tick& tick,
              const Eigen::VectorXd& unmodelled_vdot) noexcept;

  /// Acceleration of G by the push, in the plane, m/s2.
  const Eigen::Vector2d& a_WG() const { return a_WG_; }
  /// Whether a push acts now.
  bool acts() const { return acts_; }
  /// Time that the push is expected to last from now on, s; 0 without a push.
  double remaining() const;

 private:
  double mass_;
  Settings settings_;
  Eigen::Vector2d a_WG_ = Eigen::Vector2d::Zero();
  bool acts_ = false;
  double acted_for_ = 0;  // s.
  double quiet_for_ = 0;  // s.
};

}  // namespace poise
