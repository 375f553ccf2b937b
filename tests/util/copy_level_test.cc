// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/copy_level.h"

#include <gtest/gtest.h>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

TEST(CopyLevel, CopiesAllNumbers) {
  RandomHierarchyOptions options;
  options.weighted = 50;
  for (int seed = 1; seed <= 50; ++seed) {
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& from = drawn.hierarchy;
    Hierarchy to(from.num_variables(), drawn.capacity);
    to.Clear(from.num_levels());
    for (int k = from.num_levels() - 1; k >= 0; --k) CopyLevel(from, k, &to);
    for (int k = 0; k < from.num_levels(); ++k) {
      EXPECT_EQ(to.B(k), from.B(k));
      EXPECT_EQ(to.b(k), from.b(k));
      EXPECT_EQ(to.weight(k), from.weight(k));
      EXPECT_EQ(to.C(k), from.C(k));
      EXPECT_EQ(to.lower(k), from.lower(k));
      EXPECT_EQ(to.upper(k), from.upper(k));
    }
  }
}

TEST(CopyLevel, ReturnsTheNewRows) {
  const HierarchyCase drawn = MakeRandomHierarchy(1);
  Hierarchy to = drawn.hierarchy;
  to.Clear(1);
  const LevelBlocks rows = CopyLevel(drawn.hierarchy, 0, &to);
  EXPECT_EQ(rows.equalities.B.data(), to.B(0).data());
  EXPECT_EQ(rows.equalities.b.data(), to.b(0).data());
  EXPECT_EQ(rows.equalities.weight.data(), to.weight(0).data());
  EXPECT_EQ(rows.inequalities.C.data(), to.C(0).data());
  EXPECT_EQ(rows.inequalities.lower.data(), to.lower(0).data());
  EXPECT_EQ(rows.inequalities.upper.data(), to.upper(0).data());
}

}  // namespace
}  // namespace poise
