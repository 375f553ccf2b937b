// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/yaw.h"

#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

YawTask::YawTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task("yaw", {},
           FootRows(
               feet, "yaw", RowKind::kYawLimit,
               {{"max_pp", "N m", "the yaw moment of the % at its limit"},
                {"max_pm", "N m", "the yaw moment of the % at its limit"},
                {"max_mp", "N m", "the yaw moment of the % at its limit"},
                {"max_mm", "N m", "the yaw moment of the % at its limit"},
                {"min_pp", "N m", "the yaw moment of the % at its limit"},
                {"min_pm", "N m", "the yaw moment of the % at its limit"},
                {"min_mp", "N m", "the yaw moment of the % at its limit"},
                {"min_mm", "N m", "the yaw moment of the % at its limit"}})),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)),
      feet_(feet) {
  AddParameter("mu", &mu_, 0, 10);
  AddParameter("step_share", &step_share_, 0, 1);
}

void YawTask::Write(const TaskInput& input, EqualityBlock*,
                    InequalityBlock* inequalities) const noexcept {
  const double whole_mu =
      input.reference.pendulum.is_on ? step_share_ * mu_ : mu_;
  for (int i = 0; i < static_cast<int>(feet_.size()); ++i) {
    const ContactTick& contact = input.contacts[i];
    if (!contact.in_contact) continue;
    const double mu = contact.wrench_share * whole_mu;
    const double X = contact.wrench_share * feet_[i].half_size.x();
    const double Y = contact.wrench_share * feet_[i].half_size.y();
    int row = 8 * i;
    for (const double side : {1.0, -1.0}) {
      for (const double s : {1.0, -1.0}) {
        for (const double t : {1.0, -1.0}) {
          // side m_z + s (Y f_x + side mu m_x) + t (X f_y + side mu m_y)
          //     - mu (X + Y) f_z <= 0.
          Eigen::Matrix<double, 1, 6> c;
          c << s * side * mu, t * side * mu, side, s * Y, t * X, -mu * (X + Y);
          inequalities->C.block<1, 6>(row, nv_ + 6 * i) =
              inverse_force_scale_ * c;
          inequalities->upper[row] = 0;
          ++row;
        }
      }
    }
  }
}

}  // namespace poise
