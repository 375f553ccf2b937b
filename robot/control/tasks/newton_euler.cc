// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/newton_euler.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

NewtonEulerTask::NewtonEulerTask(const Tree& tree)
    : Task("newton_euler",
           AxisRows("newton_euler", RowKind::kDynamics,
                    {{"mx", "N m", "the balance of moments about x"},
                     {"my", "N m", "the balance of moments about y"},
                     {"mz", "N m", "the balance of moments about z"},
                     {"fx", "N", "the balance of forces along x"},
                     {"fy", "N", "the balance of forces along y"},
                     {"fz", "N", "the balance of forces along z"}}),
           {}),
      inverse_force_scale_(1 / ForceScale(tree)) {}

void NewtonEulerTask::Write(const TaskInput& input, EqualityBlock* equalities,
                            InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  const int nv = static_cast<int>(tick.M.rows());
  equalities->B.leftCols(nv) = inverse_force_scale_ * tick.M.topRows<6>();
  equalities->b = inverse_force_scale_ * tick.N.head<6>();
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    const ContactTick& contact = input.contacts[i];
    if (!contact.in_contact) continue;
    equalities->B.middleCols<6>(nv + 6 * i) =
        -inverse_force_scale_ * contact.J_WC_C.leftCols<6>().transpose();
  }
}

}  // namespace poise
