// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/reference.h"
#include "poise/sim/command/eased_vector.h"

namespace poise {

/// The path of the base's desired orientation: R_WB = exp([lean_W]x)
/// start_R_WB, where LeanTo() changes lean_W smoothly.
class LeanPath {
 public:
  LeanPath() = default;
  explicit LeanPath(const Eigen::Matrix3d& start_R_WB)
      : start_R_WB_(start_R_WB) {}

  /// Changes lean_W, rad, see EasedVector::GoTo().
  void LeanTo(const Eigen::Vector3d& lean_W, double time, double over);

  /// Writes the desired R_WB at a time, s. Before the first lean that is not 0,
  /// writes nothing.
  void Write(double time, Reference* reference) const;

 private:
  Eigen::Matrix3d start_R_WB_ = Eigen::Matrix3d::Identity();
  EasedVector lean_W_;
  bool leans_ = false;
};

}  // namespace poise
