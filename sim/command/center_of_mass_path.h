// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/reference.h"
#include "poise/sim/scenario.h"

namespace poise {

/// The path of the desired center of mass: a place, which ShiftTo() moves
/// smoothly, plus the sinusoid of a ComMotion.
class CenterOfMassPath {
 public:
  CenterOfMassPath() = default;
  CenterOfMassPath(const ComMotion& motion, const Eigen::Vector3d& start)
      : motion_(motion), from_(start), to_(start) {}

  /// Moves the center of the sinusoid to a place, with minimum jerk, at rest at
  /// both ends. The shift begins at `time` and takes `over` seconds. It starts
  /// from the target of the last shift, even if that shift is not complete.
  void ShiftTo(const Eigen::Vector3d& place, double time, double over);

  /// Writes the desired p_WG, v_WG and a_WG at a time, s.
  void Write(double time, Reference* reference) const;

 private:
  ComMotion motion_;
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_ = Eigen::Vector3d::Zero();
  double start_ = 0;
  double over_ = 1;
};

}  // namespace poise
