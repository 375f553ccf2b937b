// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/hqp/hierarchy.h"
#include "poise/tests/exact/exact_optimum.h"

namespace poise {

/// Checks an optimum by the conditions of hqp/solution.h, without a tolerance.
/// The conditions are necessary and sufficient, so that an answer that passes
/// is optimal however it was found. For each level k of the hierarchy, and for
/// the level of minimum norm:
///
/// - The cost is that of y.
/// - The gradient of the cost and the multipliers times their rows add up to
///   zero.
/// - A multiplier of a row that is violated by y, or at both of its bounds, is
///   free. At the upper bound it is >= 0, at the lower bound <= 0, and 0 inside
///   both bounds. A multiplier of an equality is free if its weight is not 0,
///   and otherwise 0.
///
/// Throws std::logic_error that names the level and the condition that fails.
void CheckOptimal(const Hierarchy& hierarchy, const ExactOptimum& optimum);

}  // namespace poise
