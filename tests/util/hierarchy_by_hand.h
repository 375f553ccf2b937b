// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// One row of a hierarchy: lower <= row y <= upper on a level, or row y = lower
/// if both bounds are equal.
struct RowByHand {
  int level;
  std::vector<double> row;
  double lower, upper;
};

/// A hierarchy that a test writes down row by row.
struct HierarchyByHand {
  HierarchyByHand(int num_variables, const std::vector<RowByHand>& rows);

  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

}  // namespace poise
