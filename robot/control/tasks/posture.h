// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"
#include "poise/robot/control/task.h"

namespace poise {

/// Brings each joint to the reference posture, (21):
///     q̈ = kp (q_ref - q) - kd q̇.
/// The row of joint j has the weight M_jj^e, with M_jj the inertia that the
/// joint moves. If the rows conflict, arms yield before the trunk. The exponent
/// e grows with TaskInput::capture.
class PostureTask final : public Task {
 public:
  /// Parameters: kp (60 1/s2), kd (15 1/s), inertia (0.5) and
  /// capture_inertia (1), e.
  explicit PostureTask(const Tree& tree);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int q_start_;
  int v_start_;
  double kp_ = 60;
  double kd_ = 15;
  double inertia_ = 0.5;
  double capture_inertia_ = 1;
};

}  // namespace poise
