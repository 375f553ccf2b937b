// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/robot.h"

namespace poise {

/// Smallest velocity limit that JointLimitsTask uses for a rotating joint,
/// rad/s. Smaller limits are placeholders: motors reach this speed, and a robot
/// that keeps a smaller one falls at the first impact.
constexpr double kSlowestVelocity = 3;

/// Keeps each joint inside its position limits, by bounds on its acceleration:
///     w² (lower - q) - 2 w q̇ <= q̈ <= w² (upper - q) - 2 w q̇.
/// On the bound the joint comes to rest at the limit, critically damped. The
/// two joints next to a foot in contact may brake less: at the distance d from
/// the limit and with a speed v > (2 - sqrt(2)) w d towards it by v² / (2 d),
/// at most 4 w v - w² d. This also stops them at the limit. An impact tilts a
/// sole at 10 rad/s; its rotation is a task of a lower level, and a brake that
/// is up to twice as hard as necessary would throw the robot.
///
/// A joint approaches its velocity limits as exp(-w t):
///     w (-q̇_max - q̇) <= q̈ <= w (q̇_max - q̇).
/// A joint above its velocity limit, as after an impact, brakes by at most
/// w q̇_max / 4. A rotating joint with q̇_max below q̇_5 = 5 rad/s, often a
/// placeholder, approaches its limit faster, as exp(-w q̇_5 / q̇_max t), and
/// brakes by at most w q̇_5 / 4. Limits below kSlowestVelocity count as that.
/// If a velocity limit contradicts a position limit, far beyond the position
/// limit or fast towards it, the position limit wins. A range narrower than its
/// margins shrinks to its middle. A joint without velocity limit, such as a
/// finger that mimics another, gets kAssumedVelocity; otherwise a few
/// milligrams would be accelerated by 1e6 rad/s² to supply the momentum that
/// the feet cannot. A joint without a motor (effort 0) has no bound, because no
/// torque can hold it. q̈ is v̇_j plus TaskInput::unmodelled_vdot. Without the
/// latter, a push would move the joint by w⁻² times that acceleration beyond
/// the limit. Rows are divided by w² rad.
class JointLimitsTask final : public Task {
 public:
  /// Parameters: omega (40 1/s); margin (0.008 rad), kept from each limit.
  explicit JointLimitsTask(const RobotModel& model,
                           const std::vector<Foot>& feet = {},
                           const FroudeScale& scale = {});
  bool is_two_sided() const noexcept override { return true; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int q_start_;
  int v_start_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd velocity_;
  Eigen::VectorXd fast_;  // Speed that scales the bounds; see kFast.
  std::vector<bool> is_passive_;
  std::vector<int> foot_;  // By joint: the foot next to it, or -1.
  double omega_ = 40;
  double margin_ = 0.008;
};

}  // namespace poise
