// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "poise/tools/commands/report/channel.h"

namespace poise {
namespace {

using Keep = ThinnedTable::Keep;

nlohmann::json Thin(Keep keep, long stride, const std::vector<double>& values) {
  ThinnedTable table({{"a", "m"}}, keep, stride);
  double time = 0;
  for (const double value : values) table.Add(time++, {value});
  return table.Finish();
}

// Returns the result of Finish() for these rows.
nlohmann::json Table(const std::vector<float>& time,
                     const std::vector<float>& values) {
  return {{"rows", time.size()},
          {"time", EncodeFloats(time)},
          {"channels", {EncodeChannel("a", "m", values)}}};
}

TEST(Thinning, KeepsEveryRowWithAStrideOfOne) {
  const nlohmann::json all = Table({0, 1, 2}, {5, -1, 3});
  EXPECT_EQ(Thin(Keep::kEvery, 1, {5, -1, 3}), all);
  EXPECT_EQ(Thin(Keep::kExtremes, 1, {5, -1, 3}), all);
}

TEST(Thinning, KeepsTheFirstOfEveryStride) {
  EXPECT_EQ(Thin(Keep::kEvery, 3, {0, 1, 2, 3, 4, 5, 6}),
            Table({0, 3, 6}, {0, 3, 6}));
}

TEST(Thinning, KeepsExtremesInOrderOfTime) {
  // There are three groups of four rows: a peak before a dip, a dip before a
  // peak, and a constant.
  EXPECT_EQ(Thin(Keep::kExtremes, 2, {1, 9, -3, 2, 0, -8, 7, 1, 4, 4, 4, 4}),
            Table({0, 2, 4, 6, 8, 10}, {9, -3, -8, 7, 4, 4}));
}

TEST(Thinning, KeepsIncompleteGroupAtTheEnd) {
  EXPECT_EQ(Thin(Keep::kExtremes, 2, {1, 2, 3, 4, 7}),
            Table({0, 2, 4}, {1, 4, 7}));
  EXPECT_EQ(Thin(Keep::kExtremes, 3, {1, 2, 3, 4, 5, 6, 9, 8}),
            Table({0, 3, 6, 7}, {1, 6, 9, 8}));
}

TEST(Thinning, SkipsNaN) {
  const double none = std::nan("");
  EXPECT_EQ(
      Thin(Keep::kExtremes, 2, {none, 5, none, 2, none, none, none, none}),
      Table({0, 2, 4, 6}, {5, 2, std::nanf(""), std::nanf("")}));
}

TEST(Thinning, ReturnsEmptyTableWithoutRows) {
  EXPECT_EQ(Thin(Keep::kEvery, 4, {}), Table({}, {}));
  EXPECT_EQ(Thin(Keep::kExtremes, 4, {}), Table({}, {}));
}

TEST(Thinning, UsesTheSmallestSufficientStride) {
  EXPECT_EQ(StrideFor(0, 10), 1);
  EXPECT_EQ(StrideFor(10, 10), 1);
  EXPECT_EQ(StrideFor(11, 10), 2);
  EXPECT_EQ(StrideFor(20, 10), 2);
  EXPECT_EQ(StrideFor(21, 10), 3);
}

}  // namespace
}  // namespace poise
