// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/torque_limits.h"

#include <cmath>

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

TorqueLimitsTask::TorqueLimitsTask(const RobotModel& model)
    : Task("torque_limits", {},
           JointRows(model.tree, "torque", RowKind::kTorqueLimit,
                     {"", "N m", "the torque of %"},
                     {"", "N", "the force of %"})),
      inverse_effort_(model.tree.num_joints()),
      is_passive_(model.tree.num_joints()) {
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const double effort = model.limits[j].effort;
    inverse_effort_[j] = std::isfinite(effort) && effort > 0 ? 1 / effort : 0;
    is_passive_[j] = effort == 0;
  }
  AddParameter("scale", &scale_, 1e-3, 1);
}

void TorqueLimitsTask::Write(const TaskInput& input, EqualityBlock*,
                             InequalityBlock* inequalities) const noexcept {
  const Tick& tick = input.tick;
  const int n = static_cast<int>(inverse_effort_.size());
  const int nv = static_cast<int>(tick.M.rows());
  const int start = nv - n;
  auto& C = inequalities->C;
  for (int j = 0; j < n; ++j) {
    const double inverse = is_passive_[j] ? 1 : inverse_effort_[j] / scale_;
    if (inverse == 0) continue;
    // M is symmetric to the bit: its columns are its rows, and contiguous.
    C.row(j).head(nv) = inverse * tick.M.col(start + j).transpose();
    for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
      const ContactTick& contact = input.contacts[i];
      if (!contact.in_contact) continue;
      C.row(j).segment<6>(nv + 6 * i) =
          -inverse * contact.J_WC_C.col(start + j).transpose();
    }
    const double bias = inverse * tick.N[start + j];
    const double limit = is_passive_[j] ? 0 : 1;
    inequalities->lower[j] = -limit - bias;
    inequalities->upper[j] = limit - bias;
  }
}

}  // namespace poise
