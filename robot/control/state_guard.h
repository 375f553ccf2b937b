// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/control/tick_report.h"

namespace poise {

/// Decides whether the controller may use a state: its numbers must be valid,
/// and its clock must run. A state is valid if all numbers are finite and below
/// 1e6, and the base quaternion is normalised to 1e-3.
class StateGuard {
 public:
  explicit StateGuard(const Tree& tree);

  /// Forgets the clock of earlier states.
  void Reset() noexcept;

  /// Checks the state of a new tick, dt seconds after the last one. A time
  /// stamp may stand still for 10 ms; a jump in time is a clock reset. A
  /// time stamp that is not finite gives kState, and kClock after 10 ms.
  /// @return kNone, kClock or kState.
  [[nodiscard]] FailSafeReason Check(double dt, const State& state) noexcept;

  /// Whether q and v of a state are valid; its clock does not matter.
  bool IsValid(const State& state) const noexcept;

  /// Whether the time stamp of the last state differed from the one before.
  bool clock_moves() const { return frozen_for_ == 0; }

 private:
  bool is_floating_;
  double last_time_;   // Last finite time stamp, s.
  double frozen_for_;  // How long the time stamp has stood still, s.
};

}  // namespace poise
