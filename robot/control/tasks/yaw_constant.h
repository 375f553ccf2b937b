// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Bounds the yaw moment of each foot by its load, |m_z| <= r f_z, over a
/// quarter of the robot's weight. Simpler than YawTask, but wrong near an edge
/// of the sole, where the robot can pivot.
class YawConstantTask final : public Task {
 public:
  /// Parameter: radius (0.05 m), r.
  YawConstantTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  double radius_ = 0.05;
};

}  // namespace poise
