// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/task.h"

namespace poise {

/// Keeps the floating base B from turning:
///     alpha_WB_W = -kd w_WB_W.
class BaseStillTask final : public Task {
 public:
  /// Parameter: kd (10 1/s).
  BaseStillTask();
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double kd_ = 10;
};

}  // namespace poise
