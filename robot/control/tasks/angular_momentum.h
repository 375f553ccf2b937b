// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"
#include "poise/robot/control/task.h"

namespace poise {

/// Brings the angular momentum k about the center of mass to rest:
///     (H_G v̇ + bias)_angular / m = -kd k / m.
class AngularMomentumTask final : public Task {
 public:
  /// Parameter: kd (10 1/s).
  explicit AngularMomentumTask(const Tree& tree);
  double equality_scale(int) const noexcept override { return mass_; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double mass_;
  double kd_ = 10;
};

}  // namespace poise
