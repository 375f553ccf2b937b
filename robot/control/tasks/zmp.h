// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the combined center of pressure of all feet inside a box in the
/// mid-feet frame, (12). With [m; f] the sum of the foot wrenches about the
/// origin of that frame,
///     CoP = (-m_y, m_x) / f_z,   |CoP_x| <= dx,  |CoP_y| <= dy,
/// multiplied by f_z and divided by a quarter of the robot's weight.
class ZmpTask final : public Task {
 public:
  /// Parameters: dx (half a sole's length), dy (0.1), m.
  ZmpTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  double dx_ = 0.1;
  double dy_ = 0.1;
};

}  // namespace poise
