// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Minimizes the torques of (10), each divided by its effort limit:
///     (M_u v̇ + N_u - J_{c,u}' lambda) / tau_max = 0.
class TorqueMinimizationTask final : public Task {
 public:
  explicit TorqueMinimizationTask(const RobotModel& model);
  double equality_scale(int row) const noexcept override {
    return 1 / inverse_effort_[row];
  }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  Eigen::VectorXd inverse_effort_;
};

}  // namespace poise
