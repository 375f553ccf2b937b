// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/tasks/force_regularizer.h"

#include "robot/control/tasks/row_names.h"
#include "robot/control/tasks/scale.h"

namespace poise {

ForceRegularizerTask::ForceRegularizerTask(const Tree& tree,
                                           const std::vector<Foot>& feet)
    : Task("force_regularizer",
           FootRowNames(feet, "force", {"mx", "my", "mz", "fx", "fy", "fz"}),
           {}),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {}

void ForceRegularizerTask::Write(const TaskInput& input,
                                 EqualityBlock* equalities,
                                 InequalityBlock*) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (!input.contacts[i].in_contact) continue;
    equalities->B.block<6, 6>(6 * i, nv_ + 6 * i)
        .diagonal()
        .setConstant(inverse_force_scale_);
  }
}

}  // namespace poise
