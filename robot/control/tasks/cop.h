// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the center of pressure of each foot inside its sole (table in section
/// 3 of the paper). With λ = [m; f] about the sole's center,
///     CoP = (-m_y, m_x) / f_z,
///     |CoP_x| <= X - margin,   |CoP_y| <= Y - margin.
/// The rows are multiplied by f_z and divided by a quarter of the robot's
/// weight. The margin shrinks with TaskInput::capture, from capture 0.5 on.
class CopTask final : public Task {
 public:
  /// Parameters: margin (0.005 m), capture_margin (0.001 m).
  CopTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  std::vector<Foot> feet_;
  double margin_ = 0.005;
  double capture_margin_ = 0.001;
};

}  // namespace poise
