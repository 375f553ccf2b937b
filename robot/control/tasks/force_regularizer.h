// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the contact forces small (section 3.7 of the paper): lambda = 0, over
/// a quarter of the robot's weight. Determines the internal forces.
class ForceRegularizerTask final : public Task {
 public:
  /// `scale` is that of the robot: moments are divided by its length.
  ForceRegularizerTask(const Tree& tree, const std::vector<Foot>& feet,
                       const FroudeScale& scale = {});
  double equality_scale(int row) const noexcept override {
    return 1 / (row % 6 < 3 ? inverse_moment_scale_ : inverse_force_scale_);
  }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  double inverse_moment_scale_;
};

}  // namespace poise
