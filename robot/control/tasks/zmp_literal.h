// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// The ZMP rows as the paper has them, (12) read literally: the force-weighted
/// mean of the feet's own CoPs, each in its own contact frame, within dx, dy:
///     |sum_i m_y,i| <= dx sum_i f_z,i,   |sum_i m_x,i| <= dy sum_i f_z,i.
/// These rows do not protect a foot, because +x under one foot cancels -x under
/// the other. They are for comparison; use CopTask.
class ZmpLiteralTask final : public Task {
 public:
  /// Parameters: dx, dy (half sides of the sole, m).
  ZmpLiteralTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  int nv_;
  double inverse_force_scale_;
  double dx_ = 0.1;
  double dy_ = 0.05;
};

}  // namespace poise
