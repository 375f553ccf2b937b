// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/zmp.h"

#include "poise/math/so3.h"
#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/scale.h"

namespace poise {

ZmpTask::ZmpTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task(
          "zmp", {},
          AxisRows(
              "zmp", RowKind::kCopLimit,
              {{"x_max", "N m",
                "the combined CoP at the front edge of its box"},
               {"x_min", "N m", "the combined CoP at the rear edge of its box"},
               {"y_max", "N m", "the combined CoP at the left edge of its box"},
               {"y_min", "N m",
                "the combined CoP at the right edge of its box"}})),
      nv_(tree.nv()),
      inverse_force_scale_(1 / ForceScale(tree)) {
  if (!feet.empty()) dx_ = feet.front().half_size.x();
  AddParameter("dx", &dx_, 0, 10);
  AddParameter("dy", &dy_, 0, 10);
}

void ZmpTask::Write(const TaskInput& input, EqualityBlock*,
                    InequalityBlock* inequalities) const noexcept {
  const Pose X_WMid = MidFeet(input.contacts);
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    if (!input.contacts[i].in_contact) continue;
    const Pose X_MidC = X_WMid.Inverse() * input.contacts[i].X_WC;
    // F_Mid = [ R [p]x R; 0 R ] lambda.
    Eigen::Matrix<double, 6, 6> X;
    X << X_MidC.R, Hat(X_MidC.p) * X_MidC.R, Eigen::Matrix3d::Zero(), X_MidC.R;
    X *= inverse_force_scale_;
    auto C = inequalities->C.middleCols<6>(nv_ + 6 * i);
    C.row(0) = -X.row(1) - dx_ * X.row(5);
    C.row(1) = X.row(1) - dx_ * X.row(5);
    C.row(2) = X.row(0) - dy_ * X.row(5);
    C.row(3) = -X.row(0) - dy_ * X.row(5);
    inequalities->upper.setZero();
  }
}

}  // namespace poise
