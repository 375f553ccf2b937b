// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/com_gains.h"
#include "poise/robot/control/reference.h"

namespace poise {

/// What the model does not know of and the center of mass feels, as an
/// acceleration: a wrong model lets the robot stand beside its reference, by 17
/// to 29 mm where its mass is wrong by a tenth. The integral of what the gains do
/// not explain,
///     c' = k_i (e + (k_d / k_p) e'),    e = p_ref - p_G,
/// finds it: an error on its way back, k_p e = -k_d e', is none of the model's
/// faults. In the plane it waits while the robot or its reference moves, as a lag
/// is none either; and it is at most 0.5 m/s2 there, for a center of mass that is
/// wrong by 4 cm, and 1.6 m/s2 up, for a sixth of the mass.
class Disturbance {
 public:
  void Forget() noexcept { c_W_.setZero(); }

  /// A tick of dt in which the center of mass was asked to go to its reference by
  /// these gains, and was free to.
  void Update(double dt, const ComGains& gains, const Reference& reference,
              const Tick& tick) noexcept;

  /// What the center of mass is to be accelerated by beyond its reference, m/s2.
  const Eigen::Vector3d& correction_W() const { return c_W_; }

 private:
  Eigen::Vector3d c_W_ = Eigen::Vector3d::Zero();
};

}  // namespace poise
