// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// A foot in the air feels no force: lambda = 0, over a quarter of the robot's
/// weight; no rows for a foot in contact. Belongs in the level of
/// NewtonEulerTask, with which it can always be met.
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
