// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// The joints that move less than 1e-5 of the robot's mass, and that no mimic
/// couples: fingers of 2 mg.
std::vector<int> FindLightJoints(const RobotModel& model);

/// Keeps light joints at the reference posture before the momentum is served:
///     q̈_j = kp (q_ref,j - q_j) - kd q̇_j.
/// What they could give to it is less than rounding leaves of their rows, and
/// 1e8 rad/s² would be asked for it where a push has used up all the others.
class LightJointsTask final : public Task {
 public:
  /// Parameters: kp (60 1/s2), kd (15 1/s), as of the posture.
  explicit LightJointsTask(const RobotModel& model);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int q_start_;
  int v_start_;
  std::vector<int> joints_;
  double kp_ = 60;
  double kd_ = 15;
};

}  // namespace poise
