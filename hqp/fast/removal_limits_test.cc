// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/removal_limits.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

#include "poise/hqp/hierarchy.h"

namespace poise {
namespace {

constexpr int kLevels = 2, kRows = 4;

// Row 1 of each level has equal bounds.
Hierarchy TwoLevels() {
  Hierarchy hierarchy(1, {{0, kRows}, {0, kRows}});
  for (int level = 0; level < kLevels; ++level) {
    InequalityBlock block = hierarchy.AddInequalities(level, kRows);
    block.C.setOnes();
    block.lower.setConstant(-1);
    block.upper << 1, -1, 1, 1;
  }
  return hierarchy;
}

// RemovalLimits agree with a std::map of the removals that are left, after any
// calls.
TEST(RemovalLimits, AgreeWithAMap) {
  const Hierarchy hierarchy = TwoLevels();
  RemovalLimits limits({{0, kRows}, {0, kRows}});
  limits.Reset(hierarchy);
  std::map<std::pair<int, int>, int> left;  // No entry: frozen.
  const auto reset = [&](int level) {
    for (int row = 0; row < kRows; ++row) {
      left.erase({level, row});
      if (row != 1) left[{level, row}] = RemovalLimits::kMaxRemovals;
    }
  };
  reset(0);
  reset(1);
  std::mt19937 draw(1);
  for (int turn = 0; turn < 5000; ++turn) {
    const RowIndex row = {static_cast<int>(draw() % kLevels),
                          static_cast<int>(draw() % kRows)};
    const std::pair<int, int> key{row.level, row.row};
    const bool is_frozen = left.count(key) == 0;
    ASSERT_EQ(limits.IsFrozen(row), is_frozen);
    ASSERT_EQ(limits.MayChange(row), !is_frozen && left.at(key) > 0);
    ASSERT_EQ(limits.HasAllRemovals(row),
              !is_frozen && left.at(key) == RemovalLimits::kMaxRemovals);
    const auto call = draw() % 200;
    if (call < 2) {
      limits.Reset(hierarchy, row.level);
      reset(row.level);
    } else if (call < 4) {
      limits.Freeze(row);
      left.erase(key);
    } else if (call < 10) {
      limits.Renew(row);
      if (!is_frozen) left[key] = RemovalLimits::kMaxRemovals;
    } else if (call < 12 && !is_frozen) {
      limits.Exhaust(row);
      left[key] = 0;
    } else if (limits.MayChange(row)) {
      limits.CountRemoval(row);
      --left[key];
    }
  }
}

}  // namespace
}  // namespace poise
