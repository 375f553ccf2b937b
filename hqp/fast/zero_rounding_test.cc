// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Which entries of y are taken for what rounding leaves of a zero.
#include <gtest/gtest.h>

#include <vector>

#include "poise/hqp/fast/working_set_problem.h"

namespace poise {
namespace {

constexpr double kLarge = 4;  // The largest of y: 4e-14 is nothing beside it.
constexpr double kSmall = 1e-15;   // Far below that.
constexpr double kWished = 3e-15;  // What the tail asks of y3.

using Vector = std::vector<double>;

// A row of y1 and y2, of a target, above y0 + y4 = 4, above the wish for y3.
class ZeroRoundingTest : public testing::Test {
 protected:
  // What becomes of y, asked for by a row.
  Vector Take(double b1, double b2, double target, const Vector& y,
              const Vector& row) {
    const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}, {1, 0}};
    Hierarchy hierarchy(5, capacity);
    EqualityBlock first = hierarchy.AddEqualities(0, 1);
    first.B << 0, b1, b2, 0, 0;
    first.b << -target;
    EqualityBlock sum = hierarchy.AddEqualities(1, 1);
    sum.B << 1, 0, 0, 0, 1;
    sum.b << -kLarge;
    EqualityBlock wish = hierarchy.AddEqualities(2, 1);
    wish.B << 0, 0, 0, 1, 0;
    wish.b << -kWished;
    WorkingSetProblem problem(5, capacity);
    int failed_level;
    EXPECT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
    problem.Plan(hierarchy, 3);
    problem.Solve(hierarchy, {{}, {}, {}});
    problem.SetSolution(hierarchy, y);
    any_ = problem.ZeroRoundingEntries(hierarchy, row.data());
    EXPECT_EQ(any_, problem.y() != y);
    return problem.y();
  }

  bool any_ = false;
};

TEST_F(ZeroRoundingTest, TakesWhatIsNothingBesideTheLargest) {
  for (const double sign : {1., -1.}) {
    const double nothing = sign * 3.6e-14, something = sign * 4.4e-14;
    EXPECT_EQ(Take(1, 1, 7, {kLarge, nothing, 7, 0, 0}, {0, 2, 0, 0, 0})[1], 0);
    const double just = sign * 1e-14 * kLarge;
    EXPECT_EQ(Take(1, 1, 4, {kLarge, just, kLarge, 0, 0}, {0, 2, 0, 0, 0})[1],
              0);
    EXPECT_EQ(
        Take(1, 1, 4, {kLarge, something, kLarge, 0, 0}, {0, 2, 0, 0, 0})[1],
        something);
    // Of the row alone.
    EXPECT_EQ(
        Take(1, 1, 4, {kLarge, nothing, kLarge, 0, 0}, {0, 0, 2, 1, 1})[1],
        nothing);
  }
}

TEST_F(ZeroRoundingTest, LeavesWhatARowNeeds) {
  const Vector y{kLarge, kSmall, 2 * kSmall, 0, 0};
  EXPECT_EQ(Take(1, 1, 3 * kSmall, y, {0, 1, 0, 0, 0}), y);
  EXPECT_EQ(Take(1, 1, 3 * kSmall, y, {0, 1, 1, 0, 0}), y);
  // Beside zeros, which need not become any, be it against a wish.
  const Vector one{kLarge, 0, 3 * kSmall, 0, 0};
  EXPECT_EQ(Take(1, 1, 3 * kSmall, one, {0, 1, 1, 1, 0}), one);
  // And beside a large number that no other row holds.
  const Vector large{kLarge, 3 * kSmall, 0, 1, 0};
  EXPECT_EQ(Take(1, 1, 3 * kSmall, large, {0, 1, 0, 1, 0}), large);
}

TEST_F(ZeroRoundingTest, AsksRowsOfYAsItIs) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}};
  Hierarchy hierarchy(3, capacity);
  EqualityBlock sum = hierarchy.AddEqualities(0, 1);
  sum.B << 0, 1, 1;
  sum.b << -2 * kSmall;
  EqualityBlock large = hierarchy.AddEqualities(1, 1);
  large.B << 1, 0, 0;
  large.b << -kLarge;
  WorkingSetProblem problem(3, capacity);
  int failed_level;
  EXPECT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
  problem.Plan(hierarchy, 2);
  problem.Solve(hierarchy, {{}, {}});
  const Vector y = problem.y();
  problem.SetSolution(hierarchy, {kLarge, 1, 1});  // Meets nothing.
  problem.Solve(hierarchy, {{}, {}});
  const Vector row{0, 1, 0};
  EXPECT_FALSE(problem.ZeroRoundingEntries(hierarchy, row.data()));
  EXPECT_EQ(problem.y(), y);
}

// Of a bound y1 <= 1 that was, y1 = 0 misses all.
TEST_F(ZeroRoundingTest, AsksNoRowThatIsNotActiveAnyMore) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {0, 1}};
  Hierarchy hierarchy(2, capacity);
  EqualityBlock large = hierarchy.AddEqualities(0, 1);
  large.B << 1, 0;
  large.b << -kLarge;
  InequalityBlock bound = hierarchy.AddInequalities(1, 1);
  bound.C << 0, 1;
  bound.upper << 1;
  WorkingSetProblem problem(2, capacity);
  int failed_level;
  EXPECT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
  problem.Plan(hierarchy, 2);
  for (const Side side : {Side::kUpper, Side::kNone}) {
    problem.Solve(hierarchy, {{}, {side}});
    problem.SetSolution(hierarchy, {kLarge, kSmall});
  }
  const Vector row{0, 1};
  EXPECT_TRUE(problem.ZeroRoundingEntries(hierarchy, row.data()));
  EXPECT_EQ(problem.y(), Vector({kLarge, 0}));
}

TEST_F(ZeroRoundingTest, TakesTwoThatMakeUpForEachOther) {
  const Vector y{kLarge, kSmall, kSmall, 0, 0};
  EXPECT_EQ(Take(1, -1, 0, y, {0, 1, 1, 0, 0}), Vector({kLarge, 0, 0, 0, 0}));
  // Also where only one is the row's.
  EXPECT_EQ(Take(1, -1, 0, y, {0, 1, 0, 0, 0}), Vector({kLarge, 0, 0, 0, 0}));
  EXPECT_EQ(Take(1, -1, 0, y, {1, 0, 0, 1, 1}), y);
}

// 1e-30 is no digit of a target of 1e-15.
TEST_F(ZeroRoundingTest, TakesOneWhereTheOtherIsNeeded) {
  EXPECT_EQ(
      Take(1, 2, 2 * kSmall, {kLarge, 1e-30, kSmall, 0, 0}, {0, 1, 1, 0, 0}),
      Vector({kLarge, 0, kSmall, 0, 0}));
  EXPECT_EQ(
      Take(2, 1, 2 * kSmall, {kLarge, kSmall, 1e-30, 0, 0}, {0, 1, 1, 0, 0}),
      Vector({kLarge, kSmall, 0, 0, 0}));
  EXPECT_EQ(Take(1, 1, 2 * kSmall, {kSmall, 2 * kSmall, 0, 0, kLarge},
                 {1, 1, 0, 0, 0}),
            Vector({0, 2 * kSmall, 0, 0, kLarge}));
}

// Twice as bad is as good as before: from 0.43 of its terms to 0.54, but not from
// 0.053 to 0.14.
TEST_F(ZeroRoundingTest, CountsNoLastDigit) {
  const auto take = [&](double y1, double y2, double target) {
    return Take(1, 1, target * kSmall, {kLarge, y1 * kSmall, y2 * kSmall, 0, 0},
                {0, 1, 0, 0, 0})[1];
  };
  EXPECT_EQ(take(0.2, 0.6, 2), 0);
  EXPECT_EQ(take(0.15, 0.75, 1), 0.15 * kSmall);
}

TEST_F(ZeroRoundingTest, LeavesWhatTheTailAsksFor) {
  const auto take = [&](double y3) {
    return Take(1, 1, 4, {kLarge, 0, kLarge, y3, 0}, {0, 0, 0, 1, 0})[3];
  };
  EXPECT_EQ(take(kWished), kWished);
  EXPECT_EQ(take(-kWished), 0);
  EXPECT_EQ(take(0.9 * kWished), 0);
  EXPECT_EQ(take(1.1 * kWished), 0);
}

}  // namespace
}  // namespace poise
