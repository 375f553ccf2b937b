// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the contact forces small (section 3.7 of the paper): lambda = 0, over
/// a quarter of the robot's weight. Determines the internal forces.
class ForceRegularizerTask final : public Task {
 public:
  ForceRegularizerTask(const Tree& tree, const std::vector<Foot>& feet);
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
