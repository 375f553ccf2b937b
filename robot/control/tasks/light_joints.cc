// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/light_joints.h"

#include <algorithm>
#include <vector>

#include "poise/robot/control/tasks/hanging_joints.h"
#include "poise/robot/control/tasks/row_names.h"

namespace poise {
namespace {

// Fraction of the robot's mass. The lightest fingers in use have 1e-4.
constexpr double kLight = 1e-5;

std::vector<RowDescription> Rows(const RobotModel& model) {
  std::vector<RowDescription> rows;
  for (const int j : FindLightJoints(model)) {
    rows.push_back(JointRow(
        model.tree.joints()[j], "light_joints", RowKind::kTarget,
        {"", "rad/s2", "the posture of %"}, {"", "m/s2", "the posture of %"}));
  }
  return rows;
}

}  // namespace

std::vector<int> FindLightJoints(const RobotModel& model) {
  const Tree& tree = model.tree;
  std::vector<double> mass;  // Each body and all bodies beyond it.
  for (const Inertia& M : tree.inertias()) mass.push_back(M.mass);
  for (int j = tree.num_joints() - 1; j >= 0; --j) {
    mass[tree.joints()[j].parent] += mass[j + 1];
  }
  const std::vector<bool> hangs = FindHangingJoints(model);
  std::vector<int> light;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const bool is_coupled =
        std::any_of(model.mimics.begin(), model.mimics.end(),
                    [j](const MimicCoupling& c) { return c.joint == j; });
    if (!hangs[j] && !is_coupled && mass[j + 1] < kLight * tree.total_mass()) {
      light.push_back(j);
    }
  }
  return light;
}

LightJointsTask::LightJointsTask(const RobotModel& model)
    : Task("light_joints", Rows(model), {}),
      q_start_(model.tree.q_start()),
      v_start_(model.tree.v_start()),
      joints_(FindLightJoints(model)) {
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
}

void LightJointsTask::Write(const TaskInput& input, EqualityBlock* equalities,
                            InequalityBlock*) const noexcept {
  for (int i = 0; i < static_cast<int>(joints_.size()); ++i) {
    const int j = joints_[i];
    const double e = input.reference.posture[j] - input.state.q[q_start_ + j];
    const double v = input.state.v[v_start_ + j];
    equalities->SetSingle(i, v_start_ + j, 1);
    equalities->b[i] = -kp_ * e + kd_ * v;
  }
}

}  // namespace poise
