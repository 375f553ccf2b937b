// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Position, velocity and acceleration of one coordinate that moves to rest at
/// a goal along a quintic polynomial. The polynomial is planned anew in each
/// tick from the present values, so the goal and the time may change, and the
/// motion stays continuous up to the acceleration.
struct Quintic {
  double p = 0;  ///< m.
  double v = 0;  ///< m/s.
  double a = 0;  ///< m/s2.

  /// Advances by dt on the polynomial that is at rest at the goal after a time
  /// T > 0, with dt <= T. If the goal and T - t do not change, the sequence of
  /// calls follows one and the same polynomial.
  void Advance(double dt, double goal, double T) noexcept;

  /// Brings the velocity to zero with a time constant; the position follows.
  void Brake(double dt, double time_constant) noexcept;
};

}  // namespace poise
