// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps each joint inside its position limits, by bounds on its acceleration:
///     w² (lower - q) - 2 w q̇ <= q̈ <= w² (upper - q) - 2 w q̇,
/// along which it comes to rest at the limit, critically damped; and inside its
/// velocity limits, which are approached as exp(-w t):
///     w (-q̇_max - q̇) <= q̈ <= w (q̇_max - q̇).
/// Where these contradict each other, far beyond a position limit or fast towards
/// it, the position wins; a range narrower than its margins shrinks to its middle.
/// A joint whose file has no velocity limit, as a finger that mimics another, is
/// taken to have kAssumedVelocity: were its acceleration free, a few milligrams
/// would buy the momentum that the feet cannot give with 1e6 rad/s². A joint
/// without a motor, of effort 0, has no bound: nothing can hold it, and all that the
/// robot has would be spent on trying.
/// There q̈ is what the joint will do: v̇_j and TaskInput::unmodelled_vdot, or a push
/// would press it w⁻² of that beyond where it comes to rest. Rows are divided by
/// w² rad.
class JointLimitsTask final : public Task {
 public:
  /// Parameters: omega (40 1/s); margin (0.008 rad), kept from each limit.
  explicit JointLimitsTask(const RobotModel& model);
  bool is_two_sided() const noexcept override { return true; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int q_start_;
  int v_start_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd velocity_;
  std::vector<bool> is_passive_;
  double omega_ = 40;
  double margin_ = 0.008;
};

}  // namespace poise
