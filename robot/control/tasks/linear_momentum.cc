// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/linear_momentum.h"

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

LinearMomentumTask::LinearMomentumTask(const Tree& tree)
    : Task("linear_momentum",
           AxisRows("linear_momentum", RowKind::kTarget,
                    {{"lx", "N", "the linear momentum along x"},
                     {"ly", "N", "the linear momentum along y"},
                     {"lz", "N", "the linear momentum along z"}}),
           {}),
      mass_(tree.total_mass() > 0 ? tree.total_mass() : 1) {
  AddParameter("kd", &kd_, 0, 1e3);
}

void LinearMomentumTask::Write(const TaskInput& input,
                               EqualityBlock* equalities,
                               InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  equalities->B.leftCols(tick.H_G.cols()) = tick.H_G.bottomRows<3>() / mass_;
  equalities->b = tick.H_G_bias.tail<3>() / mass_ -
                  kd_ * (input.reference.v_WG - tick.v_WG) -
                  input.reference.a_WG;
}

}  // namespace poise
