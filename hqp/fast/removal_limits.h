// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cassert>
#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// An inequality row of a hierarchy; no row if `level` is negative.
struct RowIndex {
  int level = -1, row = -1;
  bool operator==(const RowIndex& other) const {
    return level == other.level && row == other.row;
  }
};

/// Limits how often a search may remove a row from the working set. Searches
/// need fewer removals; the limit ends cycles that rounding causes. A row
/// without removals left is neither removed nor added. A frozen row is an
/// equality and stays in the working set. Nothing allocates after construction.
class RemovalLimits {
 public:
  static constexpr int kMaxRemovals = 10;

  explicit RemovalLimits(const std::vector<LevelCapacity>& capacity) {
    for (const LevelCapacity& level : capacity) {
      left_.emplace_back(level.inequalities, kMaxRemovals);
    }
  }

  /// Allows kMaxRemovals removals of each row of a level, but freezes rows
  /// whose bounds are equal.
  void Reset(const Hierarchy& hierarchy, int level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      left_[level][i] = lower[i] == upper[i] ? kFrozen : kMaxRemovals;
    }
  }
  void Reset(const Hierarchy& hierarchy) {
    for (int level = 0; level < hierarchy.num_levels(); ++level) {
      Reset(hierarchy, level);
    }
  }

  bool IsFrozen(RowIndex row) const { return At(row) == kFrozen; }
  /// Returns whether the row is not frozen and has kMaxRemovals removals left.
  bool HasAllRemovals(RowIndex row) const { return At(row) == kMaxRemovals; }
  /// Returns whether the row is not frozen and has removals left.
  bool MayChange(RowIndex row) const { return At(row) > 0; }

  /// pre: MayChange(row).
  void CountRemoval(RowIndex row) {
    assert(MayChange(row));
    --left_[row.level][row.row];
  }
  /// Leaves the row no removals.
  /// pre: !IsFrozen(row).
  void Exhaust(RowIndex row) {
    assert(!IsFrozen(row));
    left_[row.level][row.row] = 0;
  }
  /// Allows kMaxRemovals removals again, unless the row is frozen.
  void Renew(RowIndex row) {
    if (!IsFrozen(row)) left_[row.level][row.row] = kMaxRemovals;
  }
  void Freeze(RowIndex row) { left_[row.level][row.row] = kFrozen; }

 private:
  static constexpr signed char kFrozen = -1;
  signed char At(RowIndex row) const { return left_[row.level][row.row]; }

  std::vector<std::vector<signed char>> left_;  ///< By level and row.
};

}  // namespace poise
