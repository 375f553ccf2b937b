// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/same_sides.h"

#include <gtest/gtest.h>

#include <vector>

namespace poise {
namespace {

TEST(SameSides, DifferInAnyRow) {
  for (int rows = 0; rows < 20; ++rows) {
    const std::vector<Side> side(rows, Side::kLower);
    EXPECT_TRUE(AreSame(side, std::vector<Side>(rows, Side::kLower)));
    for (int i = 0; i < rows; ++i) {
      std::vector<Side> other = side;
      other[i] = i % 2 == 0 ? Side::kUpper : Side::kNone;
      EXPECT_FALSE(AreSame(side, other)) << i << " of " << rows;
      EXPECT_FALSE(AreSame(other, side)) << i << " of " << rows;
    }
  }
}

TEST(SameSides, DifferInTheNumberOfRows) {
  const std::vector<Side> none, one = {Side::kNone};
  EXPECT_FALSE(AreSame(none, one));
  EXPECT_FALSE(AreSame(one, none));
}

}  // namespace
}  // namespace poise
