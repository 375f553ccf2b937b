// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Bounds the yaw moment of each foot by what friction under a rectangular sole
/// of half sides X, Y can give, where the wrench [m; f] is about its center:
///      m_z <= mu (X + Y) f_z - |Y f_x + mu m_x| - |X f_y + mu m_y|,
///     -m_z <= mu (X + Y) f_z - |Y f_x - mu m_x| - |X f_y - mu m_y|,
/// eight linear rows, over a quarter of the robot's weight.
/// Source: Caron, Pham, Nakamura, "Stability of surface contacts for humanoid
/// robots: closed-form formulae of the contact wrench cone for rectangular
/// support areas", ICRA 2015.
class YawTask final : public Task {
 public:
  /// Parameters: mu (0.5); step_share (0.68) of mu while Reference::pendulum is
  /// on, as in FrictionTask.
  YawTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  std::vector<Foot> feet_;
  double mu_ = 0.5;
  double step_share_ = 0.68;
};

}  // namespace poise
