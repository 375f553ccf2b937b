// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps coupled joints at their sources, for robots whose profile enables the
/// task. With e = multiplier q_source + offset - q,
///     q̈ - multiplier q̈_source = kp e + kd ė.
class MimicTask final : public Task {
 public:
  /// Parameters: kp (400 1/s2), kd (40 1/s).
  explicit MimicTask(const RobotModel& model);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int q_start_;
  int v_start_;
  std::vector<MimicCoupling> couplings_;
  double kp_ = 400;
  double kd_ = 40;
};

}  // namespace poise
