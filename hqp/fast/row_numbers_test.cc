// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/row_numbers.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

#include "poise/tests/util/count_malloc.h"

namespace poise {
namespace {

// A std::map keeps the same numbers. Rows are added and removed, at most
// `kMostRows` at a time.
TEST(RowNumbers, AgreeWithAMap) {
  constexpr int kMostRows = 7, kSize = 3;
  const std::vector<LevelCapacity> capacity{{2, 5}, {0, 0}, {0, 9}};
  RowNumbers numbers(capacity, kMostRows, kSize);
  std::map<std::pair<int, int>, double> expected;
  std::mt19937 draw(1);
  for (int turn = 0; turn < 3000; ++turn) {
    const int level = draw() % 2 == 0 ? 0 : 2;
    const int row = static_cast<int>(draw() % capacity[level].inequalities);
    const std::pair<int, int> key{level, row};
    if (turn % 500 == 499) {
      numbers.Clear();
      expected.clear();
    } else if (draw() % 3 == 0 ||
               (expected.size() == kMostRows && expected.count(key) == 0)) {
      numbers.Remove(level, row);
      expected.erase(key);
    } else {
      const CountMalloc count;
      double* number = numbers.At(level, row);
      EXPECT_EQ(count.allocations(), 0);
      if (expected.count(key) == 0) {
        for (int k = 0; k < kSize; ++k) EXPECT_EQ(number[k], 0);
      }
      expected[key] = turn;
      for (int k = 0; k < kSize; ++k) number[k] = turn + 0.1 * k;
    }
    for (const auto& [at, value] : expected) {
      for (int k = 0; k < kSize; ++k) {
        EXPECT_EQ(numbers.At(at.first, at.second)[k], value + 0.1 * k);
      }
    }
  }
}

// Further rows have the number zero, whatever is written to it.
TEST(RowNumbers, AreZeroForMoreRowsThanHaveMemory) {
  RowNumbers numbers({{0, 3}}, 1, 2);
  numbers.At(0, 1)[1] = 5;
  for (int turn = 0; turn < 2; ++turn) {
    double* number = numbers.At(0, 2);
    EXPECT_EQ(number[0], 0);
    EXPECT_EQ(number[1], 0);
    number[1] = 7;
  }
  EXPECT_EQ(numbers.At(0, 1)[1], 5);
  numbers.Remove(0, 1);
  numbers.At(0, 2)[1] = 7;
  EXPECT_EQ(numbers.At(0, 2)[1], 7);
}

}  // namespace
}  // namespace poise
