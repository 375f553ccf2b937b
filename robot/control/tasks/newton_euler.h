// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"
#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// The six unactuated rows of the dynamics, (9):
///     M_l v̇ + N_l - J_{c,l}' lambda = 0,
/// divided by a quarter of the robot's weight. They can always be met.
class NewtonEulerTask final : public Task {
 public:
  explicit NewtonEulerTask(const Tree& tree);
  double equality_scale(int) const noexcept override {
    return 1 / inverse_force_scale_;
  }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double inverse_force_scale_;
};

}  // namespace poise
