// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/com_gains.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/tasks/froude.h"

namespace poise {

/// Integral action on the center of mass: estimates the acceleration that the
/// model does not contain. With a mass error of 10 %, the steady-state error is
/// 17 to 29 mm without this correction. The correction c integrates
///     c' = k_i (e + (k_d / k_p) e'),    e = p_ref - p_G.
/// An error that decays as the PD gains predict, k_p e = -k_d e', is not a
/// model error and adds nothing. In the plane, integration pauses while the
/// robot or its reference moves, because a tracking lag is not a model error
/// either. The correction is clamped to 0.5 m/s2 in the plane (a center-of-mass
/// error of 4 cm) and to 1.6 m/s2 along z (a mass error of one sixth).
class Disturbance {
 public:
  /// `scale` fits the speed of a standing robot to its size.
  explicit Disturbance(const FroudeScale& scale = {});

  /// Sets the correction to zero.
  void Forget() noexcept { c_W_.setZero(); }

  /// Integrates over dt, s. Call this only in a tick in which a task with these
  /// gains moved the center of mass, and the residual of the task was small.
  void Update(double dt, const ComGains& gains, const Reference& reference,
              const Tick& tick) noexcept;

  /// Acceleration to add to the reference of the center of mass, m/s2.
  const Eigen::Vector3d& correction_W() const { return c_W_; }

 private:
  double standing_;  // Speed of the center of mass, m/s.
  Eigen::Vector3d c_W_ = Eigen::Vector3d::Zero();
};

}  // namespace poise
