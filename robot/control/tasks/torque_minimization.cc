// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/torque_minimization.h"

#include <cmath>

#include "poise/robot/control/tasks/row_names.h"

namespace poise {
namespace {

// For a joint without a limit: about that of a humanoid's knee.
constexpr double kTypicalEffort = 100;

}  // namespace

TorqueMinimizationTask::TorqueMinimizationTask(const RobotModel& model)
    : Task("torque_minimization",
           JointRows(model.tree, "torque_minimization", RowKind::kTarget,
                     {"", "N m", "the torque of %"},
                     {"", "N", "the force of %"}),
           {}),
      inverse_effort_(model.tree.num_joints()) {
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const double effort = model.limits[j].effort;
    inverse_effort_[j] =
        1 / (std::isfinite(effort) && effort > 0 ? effort : kTypicalEffort);
  }
}

void TorqueMinimizationTask::Write(const TaskInput& input,
                                   EqualityBlock* equalities,
                                   InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  const int n = static_cast<int>(inverse_effort_.size());
  const int nv = static_cast<int>(tick.M.rows());
  const int start = nv - n;
  for (int j = 0; j < n; ++j) {
    const double inverse = inverse_effort_[j];
    equalities->B.row(j).head(nv) = inverse * tick.M.col(start + j).transpose();
    for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
      const ContactTick& contact = input.contacts[i];
      if (!contact.in_contact) continue;
      equalities->B.row(j).segment<6>(nv + 6 * i) =
          -inverse * contact.J_WC_C.col(start + j).transpose();
    }
    equalities->b[j] = inverse * tick.N[start + j];
  }
}

}  // namespace poise
