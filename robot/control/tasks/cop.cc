// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/cop.h"

#include <algorithm>
#include <string_view>

#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {
namespace {

// y of a contact frame is to the left: the outer edge of the left foot.
std::vector<RowDescription> Rows(const std::vector<Foot>& feet) {
  constexpr std::string_view kOuter = "the CoP of the % at its outer edge";
  constexpr std::string_view kInner = "the CoP of the % at its inner edge";
  std::vector<RowDescription> rows;
  for (const Foot& foot : feet) {
    const bool is_left = foot.name == "left_foot";
    AddFootRows(foot, "cop", RowKind::kCopLimit,
                {{"x_max", "N m", "the CoP of the % at its front edge"},
                 {"x_min", "N m", "the CoP of the % at its rear edge"},
                 {"y_max", "N m", is_left ? kOuter : kInner},
                 {"y_min", "N m", is_left ? kInner : kOuter}},
                &rows);
  }
  return rows;
}

}  // namespace

CopTask::CopTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task("cop", {}, Rows(feet)),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)),
      feet_(feet) {
  AddParameter("margin", &margin_, 0, 1);
  AddParameter("capture_margin", &capture_margin_, 0, 1);
}

void CopTask::Write(const TaskInput& input, EqualityBlock*,
                    InequalityBlock* inequalities) const noexcept {
  const double share = std::max(0.0, 2 * input.capture - 1);
  const double margin = BlendByCapture(margin_, capture_margin_, share);
  for (int i = 0; i < static_cast<int>(feet_.size()); ++i) {
    const ContactTick& contact = input.contacts[i];
    if (!contact.in_contact) continue;
    const double scale = contact.wrench_share * inverse_force_scale_;
    const double X = scale * std::max(0.0, feet_[i].half_size.x() - margin);
    const double Y = scale * std::max(0.0, feet_[i].half_size.y() - margin);
    auto C = inequalities->C.block<4, 6>(4 * i, nv_ + 6 * i);
    // Columns: m_x, m_y, m_z, f_x, f_y, f_z.
    C << 0, -inverse_force_scale_, 0, 0, 0, -X,  //
        0, inverse_force_scale_, 0, 0, 0, -X,    //
        inverse_force_scale_, 0, 0, 0, 0, -Y,    //
        -inverse_force_scale_, 0, 0, 0, 0, -Y;
    inequalities->upper.segment<4>(4 * i).setZero();
  }
}

}  // namespace poise
