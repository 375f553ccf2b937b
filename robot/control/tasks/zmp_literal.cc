// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/zmp_literal.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

ZmpLiteralTask::ZmpLiteralTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task(
          "zmp_literal", {},
          AxisRows(
              "zmp_literal", RowKind::kCopLimit,
              {{"x_max", "N m",
                "the combined CoP at the front edge of its box"},
               {"x_min", "N m", "the combined CoP at the rear edge of its box"},
               {"y_max", "N m", "the combined CoP at the left edge of its box"},
               {"y_min", "N m",
                "the combined CoP at the right edge of its box"}})),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {
  if (!feet.empty()) {
    dx_ = feet.front().half_size.x();
    dy_ = feet.front().half_size.y();
  }
  AddParameter("dx", &dx_, 0, 10);
  AddParameter("dy", &dy_, 0, 10);
}

void ZmpLiteralTask::Write(const TaskInput& input, EqualityBlock*,
                           InequalityBlock* inequalities) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (!input.contacts[i].in_contact) continue;
    auto C = inequalities->C.middleCols<6>(nv_ + 6 * i);
    // Columns: m_x, m_y, m_z, f_x, f_y, f_z.
    C << 0, -1, 0, 0, 0, -dx_,  //
        0, 1, 0, 0, 0, -dx_,    //
        1, 0, 0, 0, 0, -dy_,    //
        -1, 0, 0, 0, 0, -dy_;
    C *= inverse_force_scale_;
    inequalities->upper.setZero();
  }
}

}  // namespace poise
