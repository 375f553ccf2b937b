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
  /// Parameters: kp (200 1/s2), kd (28 1/s).
  SwingTask(const Foot& foot, int index);
  bool HasRows(const TaskInput& input) const noexcept override;
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int index_;
  double kp_ = 200;
  double kd_ = 28;
};

}  // namespace poise
