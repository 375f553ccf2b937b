// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/tolerance.h"

#include <cstdlib>
#include <limits>

namespace poise {

double Rounding(double scale, int n, double condition) {
  const char* factor = std::getenv("POISE_TOLERANCE_SCALE");
  return (factor != nullptr ? std::atof(factor) : 1.0) * 8 * n *
         std::numeric_limits<double>::epsilon() * condition * scale;
}

}  // namespace poise
