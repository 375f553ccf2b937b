// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/posture.h"

#include <algorithm>
#include <cmath>

#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/tasks/hanging_joints.h"
#include "poise/robot/control/tasks/row_names.h"

namespace poise {
namespace {

// Smallest and largest inertia of a weight, for robot/models/humanoid.urdf.
// Fingers have grams; a larger range of weights would lose digits.
constexpr double kLeast = 0.01;  // kg m2, or kg.
constexpr double kMost = 10;

}  // namespace

PostureTask::PostureTask(const RobotModel& model, const FroudeScale& scale)
    : Task("posture",
           JointRows(model.tree, "posture", RowKind::kTarget,
                     {"", "rad/s2", "the posture of %"},
                     {"", "m/s2", "the posture of %"}),
           {}),
      q_start_(model.tree.q_start()),
      v_start_(model.tree.v_start()),
      hangs_(FindHangingJoints(model)),
      unit_(model.tree.num_joints()),
      factor_(model.tree.num_joints()) {
  const Tree& tree = model.tree;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const bool slides = tree.joints()[j].type == JointType::kPrismatic;
    unit_[j] = slides ? scale.mass : scale.inertia();
    factor_[j] = slides ? 1 : scale.length * scale.length;
  }
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
  AddParameter("inertia", &inertia_, 0, 1);
  AddParameter("capture_inertia", &capture_inertia_, 0, 1);
}

void PostureTask::Write(const TaskInput& input, EqualityBlock* equalities,
                        InequalityBlock*) const noexcept {
  const int n = static_cast<int>(equalities->b.size());
  const double inertia =
      BlendByCapture(inertia_, capture_inertia_, input.capture);
  double last_moved = 1, last_power = 1;
  for (int j = 0; j < n; ++j) {
    if (hangs_[j]) continue;
    const double q = input.state.q[q_start_ + j];
    const double v = input.state.v[v_start_ + j];
    const double moved = std::clamp(
        input.tick.M(v_start_ + j, v_start_ + j) / unit_[j], kLeast, kMost);
    // Most joints of a humanoid move the least inertia, and powers take long.
    if (moved != last_moved) {
      last_moved = moved;
      last_power = std::pow(moved, inertia);
    }
    equalities->SetSingle(j, v_start_ + j, 1);
    equalities->weight[j] = factor_[j] * last_power;
    equalities->b[j] = -kp_ * (input.reference.posture[j] - q) + kd_ * v;
  }
}

}  // namespace poise
