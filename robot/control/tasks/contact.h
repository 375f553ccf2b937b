// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/loop_closure.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps each foot in contact at rest, (11):
///     J_C v̇ + J̇_C v = -Kd V_WC_C + Kp e,
/// with position feedback e on tilt and height only, in C's axes: the rotation
/// that makes C's z axis upright, and the distance to the ground.
///
/// While two feet are in contact, the relative motions that their legs cannot
/// make are left out of these rows, see LoopClosure: the ground and the legs
/// already prevent them. As strict rows they are nearly dependent, and would
/// accelerate the base by 1/sigma times the residual of the two contacts. A
/// motion that is locked in part has a two-sided row instead, which bounds its
/// acceleration: by 0 where the motion begins to be locked, by infinity where
/// it is locked altogether. The rows therefore depend continuously on the
/// posture. If a robot has more than two feet, the first foot in contact closes
/// a loop with each other foot in contact.
class ContactTask final : public Task {
 public:
  /// Parameters: kp (100 1/s2), kd (30 1/s).
  ContactTask(const RobotModel& model, const std::vector<Foot>& feet);
  bool is_two_sided() const noexcept override { return true; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  // Returns the loop of two feet, first < second.
  const LoopClosure& LoopOf(int first, int second) const noexcept;

  void LeaveOutLocked(const LockedMotions& locked, int first, int second,
                      EqualityBlock* equalities,
                      InequalityBlock* inequalities) const noexcept;

  // By pair of feet: 0 and 1, 0 and 2, ..., 1 and 2, ...
  std::vector<LoopClosure> loops_;
  int num_feet_;
  double gravity_;  // m/s2.
  double kp_ = 100;
  double kd_ = 30;
};

}  // namespace poise
