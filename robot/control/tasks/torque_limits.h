// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps each torque of (10) inside the effort limit of its joint:
///     -1 <= (M_u v̇ + N_u - J_{c,u}' lambda) / (scale tau_max) <= 1.
/// A joint without a limit has no bound. A joint without a motor (effort 0) is
/// passive: tau = 0, in N m or N.
class TorqueLimitsTask final : public Task {
 public:
  /// Parameter: scale (1, at most 1), a factor on all limits.
  explicit TorqueLimitsTask(const RobotModel& model);
  bool is_two_sided() const noexcept override { return true; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  Eigen::VectorXd inverse_effort_;  // 0 without a limit or a motor.
  std::vector<bool> is_passive_;
  double scale_ = 1;
};

}  // namespace poise
