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

/// Finds a minimal set of contradicting rows, in a level that cannot be met and in
/// the levels above it. Without any one of these rows the others could all be met.
/// Returns an empty vector if the level can be met.
///
/// The rows that a least-squares optimum violates contradict each other. A deletion
/// filter then leaves out one row after the other, lowest levels last, as long as
/// the remaining rows still contradict each other. The function is for explanations
/// and not for the control loop: it solves a small problem a row, and allocates.
///
/// @param tolerance  bound of a row's violation, divided by its norm.
std::vector<HierarchyRow> FindConflict(const Hierarchy& hierarchy, int level,
                                       double tolerance = 1e-6);

}  // namespace poise
