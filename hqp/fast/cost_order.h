// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// Returns whether y is lexicographically better than `other`: on the first
/// level on which their costs differ, y has the lower one. Costs differ if
/// their difference exceeds both their own rounding and what rounding of the
/// points can cause. Cost: at most 8 flops for each entry in the span of a row,
/// up to this level. Does not allocate.
bool IsBetter(const Hierarchy& hierarchy, const std::vector<double>& y,
              const std::vector<double>& other);

}  // namespace poise
