// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>

#include "poise/robot/control/reference.h"
#include "poise/robot/gait/quintic.h"

namespace poise {

/// Path of the sole of a foot that makes a step. All coordinates follow a
/// Quintic that is planned anew in each tick, so the landing place and the
/// landing time may change, and the path stays continuous up to the
/// acceleration. The sole rises, stays at that height, and descends in the last
/// part of the step. It is over its place before it lands. If the ground
/// is lower than expected, the sole sinks on at a constant speed, down to a
/// bounded depth.
class SwingPath {
 public:
  /// Shares are fractions of the whole time of the step.
  struct Settings {
    double clearance = 0.042;    ///< Height of the sole in mid-swing, m.
    double above_at = 0.95;      ///< Share at which it is over its place.
    double risen_at = 0.48;      ///< Share at which it has risen.
    double descend_from = 0.56;  ///< Share at which it begins to descend.
    double search_speed = 0.2;   ///< Sinks with this speed after the end, m/s.
    double search_depth = 0.1;   ///< Sinks to this depth below the ground, m.
  };

  void Configure(const Settings& settings) { settings_ = settings; }

  /// Starts at rest at the place p_WC, m, `height` above the ground, m.
  void Start(const Eigen::Vector2d& p_WC, double height) noexcept;

  /// Advances by dt, s, towards the landing place.
  /// @param over      time since Start(), s.
  /// @param duration  planned time of the whole step, s.
  void Advance(double dt, const Eigen::Vector2d& goal_WC, double over,
               double duration) noexcept;

  /// Writes the pose, twist and acceleration of the contact frame C. R_WC is
  /// its constant orientation, ground_z the height of the floor, m.
  void Write(const Eigen::Matrix3d& R_WC, double ground_z,
             FrameReference* out) const noexcept;

 private:
  Settings settings_;
  std::array<Quintic, 2> plane_;
  Quintic height_;
};

}  // namespace poise
