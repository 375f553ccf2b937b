// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "hqp/hierarchy.h"

namespace poise {

/// A row of a hierarchy.
struct HierarchyRow {
  int level;
  int row;
  bool equality;
};

/// The smallest answer to why a level cannot be met: rows of it and of the
/// levels above that contradict each other, of which each one is needed, so
/// that without it the others could all be met. Empty if the level can be met.
///
/// Found by leaving out one row after the other (a deletion filter, lowest
/// levels last, so that what is left is the level's own as far as can be), and
/// least squares to see whether the rest can be met. For explaining, not for
/// the control loop: it solves a problem a row, and allocates.
///
/// @param tolerance  on a row's violation, over its norm.
std::vector<HierarchyRow> FindConflict(const Hierarchy& hierarchy, int level,
                                       double tolerance = 1e-6);

}  // namespace poise
