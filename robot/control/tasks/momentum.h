// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "dynamics/tree.h"
#include "robot/control/task.h"

namespace poise {

/// Steers the momentum of the robot about its center of mass G, (20), with
/// feed-forward, over the mass m:
///     (H_G v̇ + bias) / m = [ (-kd_angular k + K e) / m ;
///                            kp (p_ref - p_G) + kd (v_ref - v_G) + a_ref ],
/// where k is the angular momentum, and e the rotation from the base's
/// orientation back to its reference: without it the pelvis drifts, as angular
/// momentum is no derivative of an orientation.
class MomentumTask final : public Task {
 public:
  /// Parameters: kp (30 1/s2), kd (10 1/s), kd_angular (10 1/s), k_orientation
  /// (150 N m/rad); ki and ki_height (15 and 60 1/s3), by which Controller
  /// corrects what a wrong model does to the place and the height;
  /// angular_weight (1), of the angular rows against the linear ones;
  /// feedforward (0; with 1, v_ref and a_ref are used).
  explicit MomentumTask(const Tree& tree);
  double equality_scale(int) const noexcept override { return mass_; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double mass_;
  double kp_ = 30;
  double kd_ = 10;
  double kd_angular_ = 10;
  double k_orientation_ = 150;
  double ki_ = 15;
  double ki_height_ = 60;
  double angular_weight_ = 1;
  double feedforward_ = 0;
};

}  // namespace poise
