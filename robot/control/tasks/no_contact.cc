// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/no_contact.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

NoContactTask::NoContactTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task("no_contact",
           FootRows(feet, "no_contact", RowKind::kDynamics,
                    {{"mx", "N m", "the moment on the % in the air about x"},
                     {"my", "N m", "the moment on the % in the air about y"},
                     {"mz", "N m", "the moment on the % in the air about z"},
                     {"fx", "N", "the force on the % in the air along x"},
                     {"fy", "N", "the force on the % in the air along y"},
                     {"fz", "N", "the force on the % in the air along z"}}),
           {}),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {}

bool NoContactTask::HasRows(const TaskInput& input) const noexcept {
  for (const ContactTick& contact : input.contacts) {
    if (!contact.in_contact) return true;
  }
  return false;
}

void NoContactTask::Write(const TaskInput& input, EqualityBlock* equalities,
                          InequalityBlock*) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (input.contacts[i].in_contact) continue;
    equalities->B.block<6, 6>(6 * i, nv_ + 6 * i)
        .diagonal()
        .setConstant(inverse_force_scale_);
  }
}

}  // namespace poise
