// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Minimum-jerk curve from 0 to 1 for t from 0 to 1, at rest at both ends: the
/// curve with the smallest integral of the squared jerk,
///     s = 10 t³ - 15 t⁴ + 6 t⁵,
/// with the rate s' = 30 t² (1 - t)² and the acceleration s'' = 60 t (1 - t) (1
/// - 2 t).
struct MinimumJerk {
  explicit MinimumJerk(double t)
      : value(t * t * t * (10 + t * (-15 + 6 * t))),
        rate(30 * t * t * (1 - t) * (1 - t)),
        acceleration(60 * t * (1 - t) * (1 - 2 * t)) {}

  double value, rate, acceleration;
};

}  // namespace poise
