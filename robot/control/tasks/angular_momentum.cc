// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/angular_momentum.h"

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

AngularMomentumTask::AngularMomentumTask(const Tree& tree)
    : Task("angular_momentum",
           AxisRows("angular_momentum", RowKind::kTarget,
                    {{"kx", "N m", "the angular momentum about x"},
                     {"ky", "N m", "the angular momentum about y"},
                     {"kz", "N m", "the angular momentum about z"}}),
           {}),
      mass_(tree.total_mass() > 0 ? tree.total_mass() : 1) {
  AddParameter("kd", &kd_, 0, 1e3);
}

void AngularMomentumTask::Write(const TaskInput& input,
                                EqualityBlock* equalities,
                                InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  equalities->B.leftCols(tick.H_G.cols()) = tick.H_G.topRows<3>() / mass_;
  equalities->b = (tick.H_G_bias.head<3>() + kd_ * tick.L_G.head<3>()) / mass_;
}

}  // namespace poise
