// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/budget.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

const std::function<double()> no_clock;

TEST(Budget, EndsAfterItsIterations) {
  Budget budget({3, 0, 1}, &no_clock);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(budget.iterations(), i);
    EXPECT_TRUE(budget.Take({}));
    EXPECT_FALSE(budget.is_spent());
  }
  EXPECT_FALSE(budget.Take({}));
  EXPECT_TRUE(budget.is_spent());
  EXPECT_EQ(budget.iterations(), 3);
}

// A limit ends one search; the rest of the budget remains.
TEST(Budget, StopsAtALimit) {
  Budget budget({3}, &no_clock);
  EXPECT_TRUE(budget.Take(1, {}));
  EXPECT_FALSE(budget.Take(1, {}));
  EXPECT_FALSE(budget.is_spent());
  EXPECT_TRUE(budget.Take(4, {}));
  EXPECT_TRUE(budget.Take(4, {}));
  EXPECT_FALSE(budget.Take(4, {}));
  EXPECT_TRUE(budget.is_spent());
  EXPECT_EQ(budget.iterations(), 3);
}

// Takes the two iterations that a limit of time allows in any case.
void TakeFree(Budget* budget) {
  EXPECT_TRUE(budget->Take({}));
  EXPECT_TRUE(budget->Take({}));
}

// The time is measured from the construction of the budget, and only if
// seconds is positive.
TEST(Budget, StopsAtItsTimeLimit) {
  double time = 100;
  const std::function<double()> now = [&] { return time; };
  Budget budget({9, 0, 2}, &now), endless({9}, &now);
  TakeFree(&budget);
  TakeFree(&endless);
  time = 102;
  EXPECT_TRUE(budget.Take({}));
  time = 102.5;
  EXPECT_FALSE(budget.Take({}));
  EXPECT_TRUE(budget.is_spent());
  EXPECT_TRUE(endless.Take({}));
  Budget short_one({9, 0, 0.5}, &now);
  time = 103.25;
  TakeFree(&short_one);
  EXPECT_FALSE(short_one.Take({}));
}

// A budget is spent as soon as the model says so, whatever the clock says.
TEST(Budget, StopsAtItsModelledTime) {
  constexpr std::int64_t kWork = 1000000;
  Budget budget({9, ModelledSeconds({kWork, 7})}, &no_clock);
  Budget endless({9}, &no_clock);
  TakeFree(&budget);
  TakeFree(&endless);
  EXPECT_TRUE(budget.Take({kWork, 7}));  // Exactly the limit.
  EXPECT_FALSE(budget.Take({kWork + 1, 7}));
  EXPECT_TRUE(budget.is_spent());
  EXPECT_TRUE(endless.Take({1000 * kWork, 7}));
}

// A limit of iterations does not limit the time. Neither do seconds without a
// clock.
TEST(Budget, KnowsWhetherItsTimeIsLimited) {
  const std::function<double()> now = [] { return 1.0; };
  EXPECT_FALSE(Budget({9}, &now).has_time_limit());
  EXPECT_FALSE(Budget({9, 0, 1}, &no_clock).has_time_limit());
  EXPECT_TRUE(Budget({9, 0, 1}, &now).has_time_limit());
  EXPECT_TRUE(Budget({9, 1}, &no_clock).has_time_limit());
}

TEST(ModelledSeconds, GrowsWithTheWork) {
  const double least = ModelledSeconds({});
  EXPECT_GT(least, 0);
  EXPECT_GT(ModelledSeconds({1}), least);
  EXPECT_GT(ModelledSeconds({0, 1}), least);
  EXPECT_GT(ModelledSeconds({0, 0, 1}), least);
  EXPECT_GT(ModelledSeconds({0, 0, 0, 1}), least);
  EXPECT_GT(ModelledSeconds({0, 0, 0, 0, 1}), least);
  EXPECT_GT(ModelledSeconds({0, 0, 0, 0, 0, 1}), least);
}

// A working set of some levels has no multipliers of the others.
TEST(ModelledSeconds, AddsLessForAWorkingSetOfSomeLevels) {
  EXPECT_LT(ModelledSeconds({0, 0, 0, 0, 0, 1}),
            ModelledSeconds({0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace poise
