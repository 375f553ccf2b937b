// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tick_report.h"

#include <algorithm>
#include <limits>

namespace poise {

void TickReport::ClearAnswer() noexcept {
  solver_status = Status::kOptimal;
  failed_level = iterations = 0;
  modelled_seconds = dynamics_residual = 0;
  y.setZero();
  for (TaskReport& task : tasks) task.residual = task.slack = 0;
  certificate = {};
  std::fill(gap.begin(), gap.end(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace poise
