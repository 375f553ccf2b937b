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
  Side side = Side::kNone;  ///< For an inequality: the bound in question.
};

/// Finds a minimal set of rows that explains why a level cannot be met. These
/// rows of this level and of the levels above contradict each other. Without
/// any one of them, the others can all be met. Returns an empty set if the
/// level can be met.
///
/// The method is a deletion filter. A least-squares problem over all rows gives
/// the violated rows, which contradict each other. Then each row is removed on
/// trial, lowest levels last. The row stays out if the rest still cannot be
/// met. The function is meant for diagnosis, not for the control loop: it
/// solves one small problem per row, and allocates.
///
/// @param tolerance  a row counts as met if its violation, over the norm of the
///                   row, is at most this.
std::vector<HierarchyRow> FindConflict(const Hierarchy& hierarchy, int level,
                                       double tolerance = 1e-6);

}  // namespace poise
