// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/robot/control/task.h"

namespace poise {

/// Moves a link's frame F as Reference::frames says, in world axes:
///     J_WF_W v̇ + J̇ v = A_ref + kd (V_ref - V_WF_W)
///                       + kp [ log(R_ref R_WF') ; p_ref - p_WF ].
class FrameTask final : public Task {
 public:
  /// Makes the task "frame." + name for the link of Tick::frames[tick_frame]
  /// and the reference Reference::frames[index].
  /// Parameters: kp (100 1/s2), kd (20 1/s); orientation, position (1): 0
  /// switches these rows off.
  FrameTask(const std::string& name, int tick_frame, int index);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int tick_frame_;
  int index_;
  double kp_ = 100;
  double kd_ = 20;
  double orientation_ = 1;
  double position_ = 1;
};

}  // namespace poise
