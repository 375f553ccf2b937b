// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/state_guard.h"

#include <cmath>
#include <limits>

namespace poise {
namespace {

// The clock counts as frozen if the time stamp stands still for longer than
// 10 ms. The margin covers rounding: ten periods of 1 ms must not exceed 10 ms.
constexpr double kFrozenAfter = 0.010 + 1e-9;  // s.
constexpr double kNever = -std::numeric_limits<double>::infinity();

// Rounding, also in single precision, and a few integration steps change the
// norm of a quaternion by far less. A larger error means invalid data.
constexpr double kQuaternionOff = 1e-3;

}  // namespace

StateGuard::StateGuard(const Tree& tree) : is_floating_(tree.is_floating()) {
  Reset();
}

void StateGuard::Reset() noexcept {
  last_time_ = kNever;
  frozen_for_ = 0;
}

bool StateGuard::IsValid(const State& state) const noexcept {
  if (!IsBelievable(state.q) || !IsBelievable(state.v)) return false;
  return !is_floating_ ||
         std::abs(state.q.segment<4>(3).norm() - 1) < kQuaternionOff;
}

FailSafeReason StateGuard::Check(double dt, const State& state) noexcept {
  const bool moves = std::isfinite(state.time) && state.time != last_time_;
  frozen_for_ = moves ? 0 : frozen_for_ + dt;
  if (moves) last_time_ = state.time;
  if (frozen_for_ > kFrozenAfter) return FailSafeReason::kClock;
  if (!std::isfinite(state.time) || !IsValid(state)) {
    return FailSafeReason::kState;
  }
  return FailSafeReason::kNone;
}

}  // namespace poise
