// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/capture_point.h"

#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/tasks/row_names.h"
#include "poise/robot/control/tasks/support_box.h"

namespace poise {

CapturePointTask::CapturePointTask(const Tree& tree,
                                   const std::vector<Foot>& feet)
    : Task(
          "capture_point", {},
          AxisRows(
              "capture_point", RowKind::kLimit,
              {{"x_max", "m", "the capture point at the front edge of support"},
               {"x_min", "m", "the capture point at the rear edge of support"},
               {"y_max", "m", "the capture point at the left edge of support"},
               {"y_min", "m",
                "the capture point at the right edge of support"}})),
      mass_(tree.total_mass() > 0 ? tree.total_mass() : 1),
      gravity_(tree.gravity_W().norm()),
      feet_(feet) {
  AddParameter("horizon", &horizon_, 1e-3, 10);
  AddParameter("margin", &margin_, 0, 1);
}

void CapturePointTask::Write(const TaskInput& input, EqualityBlock*,
                             InequalityBlock* inequalities) const noexcept {
  const Tick& tick = input.tick;
  const Pose X_WMid = MidFeet(input.contacts);
  const Pose X_MidW = X_WMid.Inverse();
  const Eigen::Vector3d p_G = X_MidW * tick.p_WG;
  const Eigen::Vector3d v_G = X_MidW.R * tick.v_WG;
  const double w = PendulumFrequency(gravity_, p_G.z());

  for (const SupportSide to : {kFront, kBack, kLeft, kRight}) {
    const int axis = to == kFront || to == kBack ? 0 : 1;
    const int side = to == kFront || to == kLeft ? 1 : -1;
    const double reach = SupportReach(feet_, input.contacts, X_MidW, to);
    if (reach < 0) continue;  // No foot is in contact.
    const double bound = reach - margin_;

    const int row = 2 * axis + (side > 0 ? 0 : 1);
    // Not Balance::xi_Mid: it holds a term of angular momentum, whose rate is
    // missing in the bound on d/dt xi.
    const double xi = side * (p_G[axis] + v_G[axis] / w);
    // In units of length: T / w a_G <= d - xi - T v_G.
    const Eigen::RowVector3d n_W =
        side * horizon_ / (w * mass_) * X_MidW.R.row(axis);
    inequalities->C.row(row).head(tick.H_G.cols()).noalias() =
        n_W * tick.H_G.bottomRows<3>();
    inequalities->upper[row] = bound - xi - side * horizon_ * v_G[axis] -
                               n_W.dot(tick.H_G_bias.tail<3>());
  }
}

}  // namespace poise
