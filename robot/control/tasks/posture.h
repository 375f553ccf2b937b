// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/robot.h"

namespace poise {

/// Brings each joint to the reference posture, (21):
///     q̈ = kp (q_ref - q) - kd q̇.
/// The row of joint j has the weight M_jj^e, with M_jj the inertia that the
/// joint moves. If the rows conflict, arms yield before the trunk. The exponent
/// e grows with TaskInput::capture. The row of a hanging joint is empty, see
/// FindHangingJoints().
class PostureTask final : public Task {
 public:
  /// Parameters: kp (60 1/s2), kd (15 1/s), inertia (0.5) and
  /// capture_inertia (1), e.
  /// Weights hold for robot/models/humanoid.urdf; `scale` fits them to the
  /// robot, so that angular accelerations count times its length.
  explicit PostureTask(const RobotModel& model, const FroudeScale& scale = {});
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int q_start_;
  int v_start_;
  std::vector<bool> hangs_;
  std::vector<double> unit_;    // Unit of inertia, by joint, kg m2 or kg.
  std::vector<double> factor_;  // Factor on the weight, by joint.
  double kp_ = 60;
  double kd_ = 15;
  double inertia_ = 0.5;
  double capture_inertia_ = 1;
};

}  // namespace poise
