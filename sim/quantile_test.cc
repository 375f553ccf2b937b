// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/quantile.h"

#include <gtest/gtest.h>

#include <vector>

namespace poise {
namespace {

TEST(Quantile, IsTheSmallestValueThatCoversTheFraction) {
  std::vector<double> values = {5, 1, 4, 2, 3};
  EXPECT_EQ(Quantile(&values, 0), 1);
  EXPECT_EQ(Quantile(&values, 0.2), 1);
  EXPECT_EQ(Quantile(&values, 0.21), 2);
  EXPECT_EQ(Quantile(&values, 0.5), 3);
  EXPECT_EQ(Quantile(&values, 0.8), 4);
  EXPECT_EQ(Quantile(&values, 0.81), 5);
  EXPECT_EQ(Quantile(&values, 1), 5);
  values = {3, 1, 4, 2};
  EXPECT_EQ(Quantile(&values, 0.5), 2);
  std::vector<float> one = {7};
  EXPECT_EQ(Quantile(&one, 0), 7);
  EXPECT_EQ(Quantile(&one, 0.999), 7);
}

}  // namespace
}  // namespace poise
