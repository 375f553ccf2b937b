// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/changed_ticks.h"

#include <gtest/gtest.h>

#include <limits>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

TEST(ChangedTicks, KeepsFirstTickAndRows) {
  const HierarchyCase drawn = MakeRandomHierarchy(7);
  const Hierarchy& first = drawn.hierarchy;
  const RecordedTicks recorded =
      MakeChangedTicks(first, drawn.capacity, 2, false);
  ASSERT_EQ(recorded.ticks.size(), 3u);
  for (int k = 0; k < first.num_levels(); ++k) {
    EXPECT_EQ(recorded.ticks[0].b(k), first.b(k));
    for (const Hierarchy& tick : recorded.ticks) {
      EXPECT_EQ(tick.B(k), first.B(k));
      EXPECT_EQ(tick.weight(k), first.weight(k));
      EXPECT_EQ(tick.C(k), first.C(k));
      EXPECT_EQ(tick.lower(k), first.lower(k));
      EXPECT_EQ(tick.upper(k), first.upper(k));
    }
  }
}

TEST(ChangedTicks, ChangesTargetsAndBoundsByOnePercent) {
  Hierarchy hierarchy(1, {{1, 2}});
  hierarchy.Clear(1);
  EqualityBlock equalities = hierarchy.AddEqualities(0, 1);
  equalities.B << 1;
  equalities.b << 100;
  InequalityBlock inequalities = hierarchy.AddInequalities(0, 2);
  inequalities.C << 1, 1;
  inequalities.lower << -1, -std::numeric_limits<double>::infinity();
  inequalities.upper << 2, 3;
  const RecordedTicks recorded =
      MakeChangedTicks(hierarchy, {{1, 2}}, 20, true);
  for (size_t i = 1; i < recorded.ticks.size(); ++i) {
    const Hierarchy& tick = recorded.ticks[i];
    EXPECT_NE(tick.b(0)[0], 100);
    EXPECT_NEAR(tick.b(0)[0], 100, 1);
    EXPECT_NE(tick.upper(0)[0], 2);
    EXPECT_NEAR(tick.upper(0)[0], 2, 0.01);
    EXPECT_NEAR(tick.upper(0)[0] - tick.lower(0)[0], 3, 1e-15);
    EXPECT_EQ(tick.lower(0)[1], -std::numeric_limits<double>::infinity());
  }
}

}  // namespace
}  // namespace poise
