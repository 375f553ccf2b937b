// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// lower <= row y <= upper on a level, or row y = lower where both are one: a
/// hierarchy written down row by row.
struct RowByHand {
  int level;
  std::vector<double> row;
  double lower, upper;
};

struct HierarchyByHand {
  HierarchyByHand(int num_variables, const std::vector<RowByHand>& rows);

  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

}  // namespace poise
