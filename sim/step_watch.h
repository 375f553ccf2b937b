// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/sim/log/tick_record.h"

namespace poise {

/// A step that the robot took. Places are those of the sole's center.
struct TakenStep {
  int foot = 0;           ///< Index of the foot.
  double at = 0;          ///< Time of the lift-off, s.
  double swing_time = 0;  ///< From lift-off to landing, s.
  bool is_commanded = false;
  bool has_landed = false;
  Eigen::Vector2d planned = Eigen::Vector2d::Zero();  ///< At the end, m.
  Eigen::Vector2d landed = Eigen::Vector2d::Zero();   ///< m.
  double touchdown_speed = 0;  ///< Along the ground, at the touch-down, m/s.
  /// Impulse of the normal force beyond the commanded one, in the first 10 ms
  /// after the touch-down, N s.
  double impact_Ns = 0;
  double slide = 0;  ///< Largest slide since the landing, m.
};

/// Collects the steps of a run from its ticks, with the plant's true state.
class StepWatch {
 public:
  void Look(const TickRecord& record);
  const std::vector<TakenStep>& steps() const { return steps_; }

 private:
  struct FootState {
    int step = -1;  // Index of its last step.
    bool steps = false;
    bool was_in_contact = true;
    double touched_at = -1;  // Time of the last touch-down, s.
    double time = 0;         // Time of the last tick, s.
    Eigen::Vector2d p_WC = Eigen::Vector2d::Zero();
  };

  void LookAtFoot(const TickRecord& record, int foot);

  std::vector<FootState> feet_;
  std::vector<TakenStep> steps_;
};

}  // namespace poise
