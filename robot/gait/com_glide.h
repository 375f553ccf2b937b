// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>

#include "poise/robot/control/reference.h"
#include "poise/robot/gait/quintic.h"

namespace poise {

/// Reference of the center of mass during a gait. Each coordinate follows a
/// Quintic that is planned anew in each tick, so the goal may move, and the
/// reference stays continuous up to the acceleration. The height counts from
/// Reference::ground_z. Nothing allocates.
class ComGlide {
 public:
  /// Starts at rest at the place p_WG of a reference.
  void StartAt(const Reference& reference) noexcept;

  /// Restarts the plane at the place p_WG with the velocity v_WG, m and m/s,
  /// without acceleration. The height goes on.
  void RestartPlane(const Eigen::Vector2d& p_WG,
                    const Eigen::Vector2d& v_WG) noexcept;

  /// Advances by dt, s, and writes p_WG, v_WG and a_WG of the reference.
  /// @param p_WG    goal in the plane, m.
  /// @param height  goal above the ground, m.
  /// @param time    until the goal is reached at rest, s. In the last 20 ms,
  ///                and after them, the motion brakes.
  void MoveTo(double dt, const Eigen::Vector2d& p_WG, double height,
              double time, Reference* reference) noexcept;

  /// Advances the height alone, and writes only z.
  void MoveHeightTo(double dt, double height, double time,
                    Reference* reference) noexcept;

 private:
  std::array<Quintic, 3> com_;  // z above the ground.
};

}  // namespace poise
