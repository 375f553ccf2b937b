// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// A row of a hierarchy.
struct HierarchyRow {
  int level;
  int row;
  bool equality;
  Side side = Side::kNone;  ///< Bound of an inequality that is meant.
};

/// The smallest answer to why a level cannot be met: rows of it and of the
/// levels above that contradict each other, of which each one is needed, so
/// that without it the others could all be met. Empty if the level can be met.
///
/// Found by least squares: the rows that its optimum violates contradict each
/// other. Of these one after the other is left out, lowest levels last, as long
/// as the rest cannot be met (a deletion filter). For explaining, not for the
/// control loop: it solves a small problem a row, and allocates.
///
/// @param tolerance  on a row's violation, over its norm.
std::vector<HierarchyRow> FindConflict(const Hierarchy& hierarchy, int level,
                                       double tolerance = 1e-6);

}  // namespace poise
