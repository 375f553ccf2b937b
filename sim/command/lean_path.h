// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/reference.h"

namespace poise {

/// The path of the base's desired orientation: R_WB = exp([lean_W]x) start_R_WB,
/// where LeanTo() changes lean_W smoothly.
class LeanPath {
 public:
  LeanPath() = default;
  explicit LeanPath(const Eigen::Matrix3d& start_R_WB)
      : start_R_WB_(start_R_WB) {}

  /// Changes lean_W, rad, with minimum jerk, at rest at both ends. The change
  /// begins at `time` and takes `over` seconds. It starts from the target of the
  /// last change, even if that change is not complete.
  void LeanTo(const Eigen::Vector3d& lean_W, double time, double over);

  /// Writes the desired R_WB at a time, s, once a lean has been wanted.
  void Write(double time, Reference* reference) const;

 private:
  Eigen::Matrix3d start_R_WB_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_ = Eigen::Vector3d::Zero();
  double start_ = 0;
  double over_ = 1;
};

}  // namespace poise
