// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>

#include "poise/robot/robot.h"

namespace poise {

/// Where a foot can stand, seen from the base: the places of the sole's center
/// for which the leg has a solution inside its joint limits, with the base
/// upright, and the sole level and along the base's heading.
///
/// Frame N: the base's heading, z up, origin on the ground below the base. The
/// region is the polygon normal(i)' u_N <= support(i, sink), for i below
/// kSides. `sink` is the height by which the base is below its nominal height.
/// With a lower base the leg reaches farther, until a joint of the bent leg is
/// at its limit, or one leg alone cannot hold the weight with bent knees.
/// Between these limits, max_sink() is where the region is largest.
class StepRegion {
 public:
  static constexpr int kSides = 12;
  static constexpr int kSinks = 6;

  /// Limits of the region.
  struct Settings {
    double max_sink = 0.1;      ///< Bound of max_sink(), m.
    double limit_margin = 0.1;  ///< Distance to the joint limits, rad.
    double reach = 0.97;        ///< Fraction of the leg's largest length.
    /// Largest torque, as a fraction of the effort limit, with which one leg
    /// holds the weight at max_sink().
    double load = 0.7;
  };

  /// Searches the region by inverse kinematics, outward from the nominal place.
  /// Costs about 0.1 s; everything else is a table.
  StepRegion(const Robot& robot, int foot, const Settings& settings);

  static Eigen::Vector2d normal(int side) noexcept;

  /// Distance of a side from N's origin, m. `sink` is clamped to [0, max_sink].
  double support(int side, double sink) const noexcept;

  /// Smallest sink at which the region contains u_N, m; max_sink if none does.
  double SinkFor(const Eigen::Vector2d& u_N) const noexcept;

  double max_sink() const { return max_sink_; }

 private:
  double max_sink_;
  std::array<std::array<double, kSides>, kSinks> support_;
};

}  // namespace poise
