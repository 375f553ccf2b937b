// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/friction.h"

#include <cmath>

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

FrictionTask::FrictionTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task("friction", {},
           FootRows(feet, "friction", RowKind::kFrictionLimit,
                    {{"x_max", "N", "the % at its friction limit"},
                     {"x_min", "N", "the % at its friction limit"},
                     {"y_max", "N", "the % at its friction limit"},
                     {"y_min", "N", "the % at its friction limit"}})),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {
  AddParameter("mu", &mu_, 0, 10);
  AddParameter("inscribed", &inscribed_, 0, 1);
  AddParameter("step_share", &step_share_, 0, 1);
}

void FrictionTask::Write(const TaskInput& input, EqualityBlock*,
                         InequalityBlock* inequalities) const noexcept {
  // A step lands with an impact, which the contact model does not contain.
  const double share = input.reference.pendulum.is_on ? step_share_ : 1;
  const double whole_mu = inverse_force_scale_ * share *
                          (inscribed_ > 0.5 ? mu_ * std::sqrt(0.5) : mu_);
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    const ContactTick& contact = input.contacts[i];
    if (!contact.in_contact) continue;
    const double mu = contact.wrench_share * whole_mu;
    auto C = inequalities->C.block<4, 3>(4 * i, nv_ + 6 * i + 3);
    // Columns: f_x, f_y, f_z.
    C << inverse_force_scale_, 0, -mu,  //
        -inverse_force_scale_, 0, -mu,  //
        0, inverse_force_scale_, -mu,   //
        0, -inverse_force_scale_, -mu;
    inequalities->upper.segment<4>(4 * i).setZero();
  }
}

}  // namespace poise
