// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"
#include "poise/sim/scenario.h"

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
  /// End of the recording [s].
  double end = 0.45;
  /// Start of the recording [s].
  double begin = 0.05;
  /// The robot. Absent: Poise's humanoid.
  std::optional<Robot> robot = std::nullopt;
  /// Replaces the push, the limits and the torque scale.
  std::optional<Scenario> scenario = std::nullopt;
};

/// Runs the robot in closed loop at 1 kHz and calls `visit` after each tick of
/// the recording. The controller has no budget unless the scenario has one.
void VisitTicks(const RecordingConditions& conditions,
                const std::function<void(const Controller&)>& visit);

/// Runs the robot as VisitTicks() and returns the controller's hierarchies.
RecordedTicks RecordTicks(const RecordingConditions& conditions);

/// Runs the robot as VisitTicks() and returns its state at the start of each
/// tick. Without errors of the sensors, the controller receives this state.
std::vector<State> RecordStates(const RecordingConditions& conditions);

}  // namespace poise
