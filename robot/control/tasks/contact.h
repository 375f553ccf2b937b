// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps each foot in contact at rest, (11):
///     J_C v̇ + J̇_C v = -Kd V_WC_C + Kp e,
/// with position feedback e on tilt and height only, in C's axes: the rotation
/// that makes C's z axis upright, and the distance to the ground.
class ContactTask final : public Task {
 public:
  /// Parameters: kp (100 1/s2), kd (30 1/s).
  explicit ContactTask(const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double kp_ = 100;
  double kd_ = 30;
};

}  // namespace poise
