// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/bounded_rows.h"

#include <gtest/gtest.h>

#include <limits>

namespace poise {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(BoundedRows, FoldsWeightsAndLeavesOutRowsWithoutEffect) {
  Hierarchy hierarchy(2, {{0, 0}, {3, 3}});
  hierarchy.Clear(2);
  EqualityBlock equalities = hierarchy.AddEqualities(1, 3);
  equalities.B << 1, 2, 0, 0, 5, 6;
  equalities.b << 3, 4, 7;
  equalities.weight << 4, 1, 0;
  InequalityBlock inequalities = hierarchy.AddInequalities(1, 3);
  inequalities.C << 0, 0, 1, 1, 8, 9;
  inequalities.lower << 0, -kInf, -kInf;
  inequalities.upper << 1, kInf, 2;

  std::vector<int> levels;
  const std::vector<BoundedRows> problem = ToBoundedRows(hierarchy, &levels);
  ASSERT_EQ(levels, std::vector<int>{1});
  ASSERT_EQ(problem[0].source, (std::vector<int>{-1, 2}));
  EXPECT_EQ(problem[0].A, (Eigen::Matrix2d() << 2, 4, 8, 9).finished());
  EXPECT_EQ(problem[0].lower, Eigen::Vector2d(-6, -kInf));
  EXPECT_EQ(problem[0].upper, Eigen::Vector2d(-6, 2));
}

}  // namespace
}  // namespace poise
