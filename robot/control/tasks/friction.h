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
  /// Parameters: mu (0.5); inscribed (0), 1 for the inscribed square.
  FrictionTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  double mu_ = 0.5;
  double inscribed_ = 0;
};

}  // namespace poise
