// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// Draws a hierarchy that SolveExactly() solves in milliseconds: 2 to 6
/// variables and 1 to 4 levels of 0 to 4 rows. One half has whole numbers from
/// -3 to 3, the other half multiples of 1/64 in the same range, so that nothing
/// is rounded on the way into a double. Weights are whole numbers from 0 to 4.
/// One row in three is zero, or a multiple of an earlier row, with the same or
/// with a new target or bounds: rows are duplicated, deficient and
/// contradictory. The same seed gives the same hierarchy on every platform.
HierarchyCase MakeSmallHierarchy(std::uint64_t seed);

}  // namespace poise
