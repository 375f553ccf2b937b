// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/force_regularizer.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

ForceRegularizerTask::ForceRegularizerTask(const Tree& tree,
                                           const std::vector<Foot>& feet,
                                           const FroudeScale& scale)
    : Task("force_regularizer",
           FootRows(feet, "force", RowKind::kTarget,
                    {{"mx", "N m", "the moment on the % about x"},
                     {"my", "N m", "the moment on the % about y"},
                     {"mz", "N m", "the moment on the % about z"},
                     {"fx", "N", "the force on the % along x"},
                     {"fy", "N", "the force on the % along y"},
                     {"fz", "N", "the force on the % along z"}}),
           {}),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)),
      inverse_moment_scale_(inverse_force_scale_ / scale.length) {}

void ForceRegularizerTask::Write(const TaskInput& input,
                                 EqualityBlock* equalities,
                                 InequalityBlock*) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (!input.contacts[i].in_contact) continue;
    for (int j = 6 * i; j < 6 * i + 6; ++j) {
      equalities->SetSingle(
          j, nv_ + j,
          j < 6 * i + 3 ? inverse_moment_scale_ : inverse_force_scale_);
    }
  }
}

}  // namespace poise
