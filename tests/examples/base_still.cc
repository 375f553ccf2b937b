// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/examples/base_still.h"

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

BaseStillTask::BaseStillTask()
    : Task("base_still",
           AxisRows("base_still", RowKind::kTarget,
                    {{"x", "rad/s2", "the rotation of the base about x"},
                     {"y", "rad/s2", "the rotation of the base about y"},
                     {"z", "rad/s2", "the rotation of the base about z"}}),
           {}) {
  AddParameter("kd", &kd_, 0, 1e3);
}

void BaseStillTask::Write(const TaskInput& input, EqualityBlock* equalities,
                          InequalityBlock*) const noexcept {
  // v begins with w_WB_W.
  equalities->B.leftCols<3>().setIdentity();
  equalities->b = kd_ * input.state.v.head<3>();
}

}  // namespace poise
