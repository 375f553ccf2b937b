// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps each foot from sliding, (13) and (14). A square approximates the
/// friction circle of radius mu f_z: circumscribed as in the paper (√2 mu on
/// the diagonal),
///     |f_x| <= mu f_z,  |f_y| <= mu f_z,
/// or inscribed, with mu / √2; over a quarter of the robot's weight.
class FrictionTask final : public Task {
 public:
  /// Parameters: mu (0.5); inscribed (0), 1 for the inscribed square;
  /// step_share (0.85) of mu while Reference::pendulum is on, because a step
  /// lands with an impact that the dynamics do not contain.
  FrictionTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  double mu_ = 0.5;
  double inscribed_ = 0;
  double step_share_ = 0.85;
};

}  // namespace poise
