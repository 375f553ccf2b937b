// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/tasks/froude.h"

namespace poise {

/// Estimates the unmodelled acceleration: the part of v̇ that the last
/// solutions did not predict. A push or a wrong model causes it. With
/// v_predicted = v + dt v̇ of the last solution, the estimate is the
/// first-order mean over 20 ms of
///     (v - v_predicted) / dt,
/// clamped to 100 rad/s2 or m/s2: a larger value is not from a push. Both
/// numbers hold for robot/models/humanoid.urdf and are scaled to the robot.
class UnmodelledAcceleration {
 public:
  /// `nv` is the number of velocities. The estimate starts at zero.
  explicit UnmodelledAcceleration(int nv, const FroudeScale& scale = {});

  /// Sets the estimate to zero and forgets the prediction.
  void Reset() noexcept;

  /// Drops the prediction: Update() keeps the estimate until the next
  /// Predict().
  void ForgetPrediction() noexcept { predicts_ = false; }

  /// Compares v, dt after the state of the last Predict(), with its prediction.
  void Update(double dt, const Eigen::VectorXd& v) noexcept;

  /// Predicts v of the next tick from v and v̇ of this one. Does not allocate.
  void Predict(double dt, const Eigen::VectorXd& v,
               const Eigen::Ref<const Eigen::VectorXd>& vdot) noexcept;

  const Eigen::VectorXd& vdot() const { return vdot_; }

 private:
  double memory_;   // s.
  double largest_;  // rad/s2 or m/s2.
  Eigen::VectorXd vdot_;
  Eigen::VectorXd predicted_v_;
  bool predicts_ = false;  // Whether predicted_v_ is from the last tick.
};

}  // namespace poise
