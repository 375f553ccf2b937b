// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/mimic.h"

#include <vector>

#include "poise/robot/control/tasks/row_names.h"

namespace poise {
namespace {

std::vector<RowDescription> Rows(const RobotModel& model) {
  std::vector<RowDescription> rows;
  for (const MimicCoupling& coupling : model.mimics) {
    rows.push_back(JointRow(model.tree.joints()[coupling.joint], "mimic",
                            RowKind::kTarget,
                            {"", "rad/s2", "the coupling of %"},
                            {"", "m/s2", "the coupling of %"}));
  }
  return rows;
}

}  // namespace

MimicTask::MimicTask(const RobotModel& model)
    : Task("mimic", Rows(model), {}),
      q_start_(model.tree.q_start()),
      v_start_(model.tree.v_start()),
      couplings_(model.mimics) {
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
}

void MimicTask::Write(const TaskInput& input, EqualityBlock* equalities,
                      InequalityBlock*) const noexcept {
  const auto q = input.state.q.tail(input.state.q.size() - q_start_);
  const auto v = input.state.v.tail(input.state.v.size() - v_start_);
  for (int i = 0; i < static_cast<int>(couplings_.size()); ++i) {
    const MimicCoupling& c = couplings_[i];
    const double e = c.multiplier * q[c.source] + c.offset - q[c.joint];
    const double e_dot = c.multiplier * v[c.source] - v[c.joint];
    equalities->B(i, v_start_ + c.joint) = 1;
    equalities->B(i, v_start_ + c.source) -= c.multiplier;
    equalities->b[i] = -kp_ * e - kd_ * e_dot;
  }
}

}  // namespace poise
