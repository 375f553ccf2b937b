// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/measure_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace poise {
namespace {

TEST(Accuracy, IsWithinTheBarEverywhere) {
  const std::vector<Accuracy> accuracy = MeasureAccuracy(20);
  // 17 results on 16 ranges, without those that are undefined above π or 2 π.
  EXPECT_EQ(accuracy.size(), 9 * 16 + 4 * 10 + 4 * 14);
  for (const Accuracy& a : accuracy) {
    EXPECT_LE(a.error, a.bar) << a.map << " at " << a.angle;
  }
}

TEST(Accuracy, TableHasALineARow) {
  std::ostringstream table;
  WriteAccuracy({{"ExpSo3", 0.5, 1, 1.234, 4, 0.75}}, table);
  EXPECT_EQ(table.str(),
            "| map | angles | error | at most | met at |\n"
            "|---|---|---|---|---|\n"
            "| ExpSo3 | 0.5 ... 1 | 1.23 | 4 | 0.75 |\n");
}

}  // namespace
}  // namespace poise
