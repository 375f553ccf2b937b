// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"
#include "poise/robot/control/task.h"

namespace poise {

/// Brings the linear momentum to its reference, without position feedback:
///     (H_G v̇ + bias)_linear / m = kd (v_ref - v_G) + a_ref.
class LinearMomentumTask final : public Task {
 public:
  /// Parameter: kd (10 1/s).
  explicit LinearMomentumTask(const Tree& tree);
  double equality_scale(int) const noexcept override { return mass_; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double mass_;
  double kd_ = 10;
};

}  // namespace poise
