// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>

#include "poise/robot/control/stack.h"

namespace poise {

/// Gives the limits of the contact forces priority over the rows that keep the
/// feet at rest. Both are on one level. They contradict each other if a foot
/// touches the ground faster than the motors can stop it. With equal weights,
/// the optimum of the level has forces that pull at the ground, as its
/// residuals of the motion, in m/s2, are hundreds of times those of the forces,
/// in parts of the robot's weight. With priority, the forces stay possible and
/// the foot stops later. While the level is feasible, its solution does not
/// change.
class ForcePriority {
 public:
  /// Factor on the weights of the limits.
  static constexpr double kFactor = 1e4;

  /// Raises or restores the weights of the tasks "cop", "friction",
  /// "unilateral" and "yaw". Does nothing if they are as wanted. A weight that
  /// the program changes in between is overwritten by the restoration. Does not
  /// allocate.
  void Set(bool is_on, Stack* stack) noexcept;

 private:
  static constexpr int kTasks = 4;

  bool is_on_ = false;
  std::array<double, kTasks> before_{};
};

}  // namespace poise
