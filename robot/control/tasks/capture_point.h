// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the capture point above the feet. The capture point is the place where
/// the robot would have to step to come to rest. With w = sqrt(g / height of G
/// above the soles), in the mid-feet frame,
///     xi = p_G + v_G / w,      d/dt xi = v_G + a_G / w,
///     xi + T d/dt xi <= d      in +x, -x, +y, -y,
/// as rows in the acceleration a_G of the center of mass. xi then approaches
/// the bound d no faster than exp(-t / T). d is the box around the soles in
/// contact minus the margin.
class CapturePointTask final : public Task {
 public:
  /// Parameters: horizon (0.1 s), T; margin (0.02 m).
  CapturePointTask(const Tree& tree, const std::vector<Foot>& feet);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  double mass_;
  double gravity_;
  std::vector<Foot> feet_;
  double horizon_ = 0.1;
  double margin_ = 0.02;
};

}  // namespace poise
