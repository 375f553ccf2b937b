// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/com.h"

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

ComTask::ComTask(const Tree& tree)
    : Task("com",
           AxisRows("com", RowKind::kTarget,
                    {{"x", "m/s2", "the center of mass along x"},
                     {"y", "m/s2", "the center of mass along y"},
                     {"z", "m/s2", "the center of mass along z"}}),
           {}),
      mass_(tree.total_mass() > 0 ? tree.total_mass() : 1) {
  AddParameter("kp", &gains_.kp, 0, 1e4);
  AddParameter("kd", &gains_.kd, 0, 1e3);
  AddParameter("ki", &gains_.ki, 0, 100);
  AddParameter("ki_height", &gains_.ki_height, 0, 100);
}

void ComTask::Write(const TaskInput& input, EqualityBlock* equalities,
                    InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  const Reference& reference = input.reference;
  equalities->B.leftCols(tick.H_G.cols()) = tick.H_G.bottomRows<3>() / mass_;
  equalities->b = tick.H_G_bias.tail<3>() / mass_ -
                  gains_.kp * (reference.p_WG - tick.p_WG) -
                  gains_.kd * (reference.v_WG - tick.v_WG) - reference.a_WG -
                  input.correction_W;
}

}  // namespace poise
