// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the joints that move less than 1e-5 of the robot's mass and have no
/// mimic coupling, such as fingers of 2 mg. Hanging joints are left out, see
/// FindHangingJoints().
std::vector<int> FindLightJoints(const RobotModel& model);

/// Keeps light joints at the reference posture, on a level above momentum:
///     q̈_j = kp (q_ref,j - q_j) - kd q̇_j.
/// Their contribution to momentum is below rounding. When a push has used up
/// all other joints, the momentum task would accelerate them by 1e8 rad/s².
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
