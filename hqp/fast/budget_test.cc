// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/budget.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(Budget, EndsAfterItsIterations) {
  const std::function<double()> no_clock;
  Budget budget(3, 1, &no_clock);
  EXPECT_EQ(budget.max_iterations(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(budget.iterations(), i);
    EXPECT_TRUE(budget.Take());
  }
  EXPECT_FALSE(budget.Take());
  EXPECT_EQ(budget.iterations(), 3);
}

TEST(Budget, StopsAtALimit) {
  const std::function<double()> no_clock;
  Budget budget(3, 0, &no_clock);
  EXPECT_TRUE(budget.Take(1));
  EXPECT_FALSE(budget.Take(1));
  EXPECT_TRUE(budget.Take(4));
  EXPECT_TRUE(budget.Take(4));
  EXPECT_FALSE(budget.Take(4));
  EXPECT_EQ(budget.iterations(), 3);
}

// The time is measured from the construction of the budget, and only if
// max_seconds is positive.
TEST(Budget, StopsAtItsTimeLimit) {
  double time = 100;
  const std::function<double()> now = [&] { return time; };
  Budget budget(9, 2, &now), endless(9, 0, &now);
  time = 102;
  EXPECT_TRUE(budget.Take());
  time = 102.5;
  EXPECT_FALSE(budget.Take());
  EXPECT_TRUE(endless.Take());
  Budget short_one(9, 0.5, &now);
  time = 103.25;
  EXPECT_FALSE(short_one.Take());
}

}  // namespace
}  // namespace poise
