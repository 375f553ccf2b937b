// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/tests/exact/rational.h"

namespace poise {

/// The multipliers that one level puts on the rows of a level above. Two-sided
/// rows: positive at upper, negative at lower.
struct ExactMultipliers {
  RationalVector equality, inequality;
};

/// The exact optimum of one level.
struct ExactLevel {
  Rational cost;  ///< 1/2 (sum weight (B y + b)^2 + |slack|^2).
  /// Number of variables minus the rank of the equalities of nonzero weight and
  /// the violated rows of this level and the levels above.
  int nullity;
  std::vector<ExactMultipliers> multipliers;  ///< By level above.
};

/// The exact optimum of a hierarchy. Its last level is one more than the
/// hierarchy has: the rows y = 0, that is minimum norm.
struct ExactOptimum {
  RationalVector y;
  std::vector<ExactLevel> levels;
};

}  // namespace poise
