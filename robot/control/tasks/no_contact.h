// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Sets the wrench of a foot in the air to zero: lambda = 0, divided by a
/// quarter of the robot's weight. A foot in contact has no rows. The task
/// belongs on the level of NewtonEulerTask; both together can always be met.
class NoContactTask final : public Task {
 public:
  NoContactTask(const Tree& tree, const std::vector<Foot>& feet);
  bool HasRows(const TaskInput& input) const noexcept override;
  double equality_scale(int) const noexcept override {
    return 1 / inverse_force_scale_;
  }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
};

}  // namespace poise
