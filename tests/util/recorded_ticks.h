// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// The hierarchies of consecutive ticks of one run.
struct RecordedTicks {
  std::vector<LevelCapacity> capacity;
  std::vector<Hierarchy> ticks;
};

/// The conditions of a recorded run.
struct RecordingConditions {
  /// Force of the push to the side [N], for 0.15 s from 0.1 s on. 0: no push.
  double push_force = 0;
  /// Whether torque and joint limits are on. Each has 50 two-sided rows.
  bool has_limits = false;
  /// Available share of the torque limits from 0.1 s on, 0 to 1.
  double torque_scale = 1;
  /// End of the recording [s]. It begins at 0.05 s.
  double end = 0.45;
};

/// Runs the humanoid in closed loop at 1 kHz and returns the hierarchies of its
/// controller.
RecordedTicks RecordTicks(const RecordingConditions& conditions);

}  // namespace poise
