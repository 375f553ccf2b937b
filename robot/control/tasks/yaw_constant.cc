// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/yaw_constant.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

YawConstantTask::YawConstantTask(const Tree& tree,
                                 const std::vector<Foot>& feet)
    : Task("yaw_constant", {},
           FootRows(feet, "yaw_constant", RowKind::kYawLimit,
                    {{"max", "N m", "the yaw moment of the % at its limit"},
                     {"min", "N m", "the yaw moment of the % at its limit"}})),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {
  AddParameter("radius", &radius_, 0, 1);
}

void YawConstantTask::Write(const TaskInput& input, EqualityBlock*,
                            InequalityBlock* inequalities) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (!input.contacts[i].in_contact) continue;
    auto C = inequalities->C.block<2, 4>(2 * i, nv_ + 6 * i + 2);
    // Columns: m_z, f_x, f_y, f_z.
    C << inverse_force_scale_, 0, 0, -inverse_force_scale_ * radius_,  //
        -inverse_force_scale_, 0, 0, -inverse_force_scale_ * radius_;
    inequalities->upper.segment<2>(2 * i).setZero();
  }
}

}  // namespace poise
