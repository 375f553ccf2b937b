// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/quintic.h"

#include <cmath>

namespace poise {

// x(s) = p + V s + A/2 s² + c3 s³ + c4 s⁴ + c5 s⁵ in the time s = t / T, with
// x(1) = goal and x'(1) = x''(1) = 0.
void Quintic::Advance(double dt, double goal, double T) noexcept {
  const double V = v * T;
  const double A = a * T * T;
  const double way = goal - p;
  const double c3 = 10 * way - 6 * V - 1.5 * A;
  const double c4 = -15 * way + 8 * V + 1.5 * A;
  const double c5 = 6 * way - 3 * V - 0.5 * A;
  const double s = dt / T;
  p += s * (V + s * (0.5 * A + s * (c3 + s * (c4 + s * c5))));
  v = (V + s * (A + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / T;
  a = (A + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (T * T);
}

void Quintic::Brake(double dt, double time_constant) noexcept {
  const double kept = std::exp(-dt / time_constant);
  p += v * time_constant * (1 - kept);
  v *= kept;
  a = -v / time_constant;
}

}  // namespace poise
