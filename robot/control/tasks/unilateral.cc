// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/unilateral.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

UnilateralTask::UnilateralTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task("unilateral", {},
           FootRows(feet, "unilateral", RowKind::kNormalForceLimit,
                    {{"fz", "N", "the normal force of the %"}})),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {}

void UnilateralTask::Write(const TaskInput& input, EqualityBlock*,
                           InequalityBlock* inequalities) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (!input.contacts[i].in_contact) continue;
    inequalities->SetSingle(i, nv_ + 6 * i + 5, inverse_force_scale_);
    inequalities->lower[i] = 0;
    inequalities->upper[i] =
        inverse_force_scale_ * input.contacts[i].max_normal_force;
  }
}

}  // namespace poise
