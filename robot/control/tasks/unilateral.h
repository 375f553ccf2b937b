// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the normal force of the ground from pulling: 0 <= f_z <=
/// ContactTick::max_normal_force for each foot, over a quarter of the robot's
/// weight.
class UnilateralTask final : public Task {
 public:
  UnilateralTask(const Tree& tree, const std::vector<Foot>& feet);
  bool is_two_sided() const noexcept override { return true; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
};

}  // namespace poise
