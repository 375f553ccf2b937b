// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/reference.h"
#include "poise/sim/scenario.h"

namespace poise {

/// The path of the desired center of mass: smooth shifts between places, plus a
/// sinusoid about the place.
class CenterOfMassPath {
 public:
  CenterOfMassPath() = default;
  CenterOfMassPath(const ComMotion& motion, const Eigen::Vector3d& start)
      : motion_(motion), from_(start), to_(start) {}

  /// Shifts from the present target to a place, in `over` seconds from `time` on. The
  /// path has minimum jerk and is at rest at both ends.
  void ShiftTo(const Eigen::Vector3d& place, double time, double over);

  /// Writes p_WG, v_WG and a_WG.
  void Write(double time, Reference* reference) const;

 private:
  ComMotion motion_;
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_ = Eigen::Vector3d::Zero();
  double start_ = 0;
  double over_ = 1;
};

}  // namespace poise
