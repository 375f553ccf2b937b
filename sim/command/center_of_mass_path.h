// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/reference.h"
#include "poise/sim/command/eased_vector.h"
#include "poise/sim/scenario.h"

namespace poise {

/// The path of the desired center of mass: a place, which ShiftTo() moves
/// smoothly, plus the sinusoid of a ComMotion.
class CenterOfMassPath {
 public:
  CenterOfMassPath() = default;
  CenterOfMassPath(const ComMotion& motion, const Eigen::Vector3d& start)
      : motion_(motion), center_(start) {}

  /// Moves the center of the sinusoid to a place, see EasedVector::GoTo().
  void ShiftTo(const Eigen::Vector3d& place, double time, double over) {
    center_.GoTo(place, time, over);
  }

  /// Writes the desired p_WG, v_WG and a_WG at a time, s.
  void Write(double time, Reference* reference) const;

 private:
  ComMotion motion_;
  EasedVector center_;
};

}  // namespace poise
