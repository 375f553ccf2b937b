// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/budget.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

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

TEST(Budget, AllowsTheLargestNumberOfIterations) {
  Budget budget({std::numeric_limits<int>::max()}, &no_clock);
  EXPECT_TRUE(budget.Take({}));
  EXPECT_FALSE(budget.is_spent());
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

// A share of the time ends one search; the rest of the time remains. A share
// does not hold for the first two iterations, nor without a limit of time.
TEST(Budget, StopsAtItsShareOfTheTime) {
  constexpr std::int64_t kWork = 1000000;
  double time = 100;
  const std::function<double()> now = [&] { return time; };
  Budget modelled({9, ModelledSeconds({kWork, 7})}, &no_clock);
  Budget timed({9, 0, 4}, &now), endless({9}, &now);
  for (Budget* budget : {&modelled, &timed, &endless}) {
    const Work work = budget == &modelled ? Work{kWork * 3 / 4, 7} : Work{};
    time = 100;
    budget->set_share(0.5);
    EXPECT_TRUE(budget->Take(work));
    EXPECT_TRUE(budget->Take(work));
    EXPECT_FALSE(budget->is_share_spent());
    time = 103;
    EXPECT_EQ(budget->Take(work), budget == &endless);
    EXPECT_EQ(budget->is_share_spent(), budget != &endless);
    EXPECT_FALSE(budget->is_spent());
    budget->set_share(1);
    EXPECT_TRUE(budget->Take(work));
    EXPECT_FALSE(budget->is_share_spent());
  }
}

// Each Take() reads the clock once, so that a clock that goes on cannot end the
// share, but not the time, of a budget without a share.
TEST(Budget, ReadsTheClockOncePerIteration) {
  int reads = 0;
  const std::function<double()> now = [&] { return ++reads; };
  Budget budget({99, 0, 3.5}, &now);
  TakeFree(&budget);
  int taken = 0;
  while (budget.Take({})) ++taken;
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(reads, 1 + taken + 1);
  EXPECT_TRUE(budget.is_spent());
  EXPECT_FALSE(budget.is_share_spent());
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

// With all of them, the modelled time is kMost times the limit, to one
// multiply-add.
TEST(Budget, LeavesTheMultiplyAddsUntilItsMost) {
  Work work = {1000, 7, 3, 20, 2, 1};
  const double limit = 2 * ModelledSeconds(work);
  Budget budget({9, limit}, &no_clock);
  TakeFree(&budget);
  EXPECT_TRUE(budget.Take({}));
  const std::int64_t left = budget.MultiplyAddsLeft(work);
  work.multiply_adds += left;
  const double most = Budget::kMost * limit;
  EXPECT_NEAR(ModelledSeconds(work), most, kSecondsPerMultiplyAdd);
}

TEST(Budget, LeavesTheMultiplyAddsOfTheTimeByTheClock) {
  double time = 5;
  const std::function<double()> now = [&] { return time; };
  Budget budget({9, 0, 2}, &now), both({9, 1e-3, 2}, &now),
      modelled({9, 1e-3}, &no_clock);
  for (Budget* each : {&budget, &both, &modelled}) {
    TakeFree(each);
    EXPECT_TRUE(each->Take({}));
  }
  time = 6;
  const double seconds = Budget::kMost * 2 - 1;
  EXPECT_NEAR(
      static_cast<double>(budget.MultiplyAddsLeft({})) * kSecondsPerMultiplyAdd,
      seconds, kSecondsPerMultiplyAdd);
  // The earlier limit holds.
  EXPECT_EQ(both.MultiplyAddsLeft({}), modelled.MultiplyAddsLeft({}));
}

// The first two iterations may take any time, because the search must advance.
// A later one has a limit, even if the time ends right after its begin.
TEST(Budget, LeavesAllMultiplyAddsForTheFirstIterations) {
  constexpr std::int64_t kUnlimited = Budget::kUnlimited;
  double time = 5;
  const std::function<double()> now = [&] { return time; };
  Budget endless({9}, &no_clock),
      modelled({9, ModelledSeconds({1000000})}, &no_clock);
  Budget by_clock({9, 0, 2}, &now);
  time = 6.9;
  for (int iteration = 1; iteration <= 3; ++iteration) {
    for (Budget* budget : {&endless, &modelled, &by_clock}) {
      EXPECT_TRUE(budget->Take({1000000}));
      EXPECT_EQ(budget->MultiplyAddsLeft({1000000}) == kUnlimited,
                iteration < 3 || budget == &endless)
          << iteration;
    }
  }
  time = 7.1;
  EXPECT_LT(by_clock.MultiplyAddsLeft({}), kUnlimited);
  EXPECT_GT(by_clock.MultiplyAddsLeft({}), 0);
}

TEST(Budget, LeavesManyMultiplyAddsInALongTime) {
  const std::function<double()> now = [] { return 0.0; };
  for (const double seconds :
       {1e3, 1e12, std::numeric_limits<double>::infinity()}) {
    Budget modelled({9, seconds}, &no_clock), by_clock({9, 0, seconds}, &now);
    for (Budget* budget : {&modelled, &by_clock}) {
      TakeFree(budget);
      EXPECT_TRUE(budget->Take({}));
      EXPECT_GT(budget->MultiplyAddsLeft({}), 1000000000);
    }
  }
}

TEST(Budget, LeavesNoMultiplyAddsAfterAJumpOfTheClock) {
  double time = 0;
  const std::function<double()> now = [&] { return time; };
  Budget budget({9, 0, 1}, &now);
  TakeFree(&budget);
  EXPECT_TRUE(budget.Take({}));
  time = 1e300;
  EXPECT_EQ(budget.MultiplyAddsLeft({}), -Budget::kUnlimited);
}

TEST(Budget, AllowsNoIterationOnceItIsSpent) {
  Budget budget({9}, &no_clock);
  EXPECT_TRUE(budget.Take({}));
  budget.Spend();
  EXPECT_TRUE(budget.is_spent());
  EXPECT_FALSE(budget.Take({}));
  EXPECT_EQ(budget.iterations(), 1);
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
