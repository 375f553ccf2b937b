// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Moves the contact frame C of a foot in the air as Reference::feet says, in
/// C's axes, R = R_CW:
///     J_WC_C v̇ + J̇ v = R A_ref + kd (R V_ref - V_WC_C)
///                       + kp R [ log(R_ref R_WC') ; p_ref - p_WC ].
/// The task has no rows while the foot is in contact.
class SwingTask final : public Task {
 public:
  /// Makes the task "frame." + name of the foot.
  /// Parameters: kp (200 1/s2), kd (28 1/s). During a step, see
  /// Stance::Step(): step_kp (720 1/s2), step_kd (53.7 1/s), and the weights of
  /// the rows, step_orientation_weight (0.41), step_plane_weight (0.2) and
  /// step_height_weight (3.6).
  SwingTask(const Foot& foot, int index);
  bool HasRows(const TaskInput& input) const noexcept override;
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int index_;
  double kp_ = 200;
  double kd_ = 28;
  double step_kp_ = 720;
  double step_kd_ = 53.7;
  double step_orientation_weight_ = 0.41;
  double step_plane_weight_ = 0.2;
  double step_height_weight_ = 3.6;
};

}  // namespace poise
