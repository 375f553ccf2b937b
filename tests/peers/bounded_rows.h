// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// A level as rows lower <= A y <= upper, the form that the peers share. An
/// equality has lower = upper; its weight is folded in by its square root. Rows
/// of zero length, zero weight or without a bound are left out.
struct BoundedRows {
  Eigen::MatrixXd A;
  Eigen::VectorXd lower, upper;
  /// Row of C of the hierarchy, by row of A; -1 for an equality.
  std::vector<int> source;

  int rows() const { return static_cast<int>(source.size()); }
};

/// The active bound of each inequality row, by level and row of C.
using ActiveSides = std::vector<std::vector<Side>>;

/// Returns all levels that have a row; level[i] is the hierarchy's level.
std::vector<BoundedRows> ToBoundedRows(const Hierarchy& hierarchy,
                                       std::vector<int>* levels);

/// Returns no active bound for each row of the capacity.
ActiveSides NoActiveSides(const std::vector<LevelCapacity>& capacity);

/// Makes all bounds inactive.
void Deactivate(ActiveSides* sides);

/// Returns whether two problems have levels with the same numbers of rows.
bool HaveSameSizes(const std::vector<BoundedRows>& a,
                   const std::vector<BoundedRows>& b);

}  // namespace poise
