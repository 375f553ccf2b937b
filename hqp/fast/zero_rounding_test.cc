// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests which entries of y are set to zero as rounding.
#include <gtest/gtest.h>

#include <vector>

#include "poise/hqp/fast/working_set_problem.h"

namespace poise {
namespace {

constexpr double kLarge = 4;       // The largest entry of y.
constexpr double kSmall = 1e-15;   // Within the rounding of kLarge.
constexpr double kTarget = 3e-15;  // Target of the last level for y3.

using Vector = std::vector<double>;

// Level 0: a row of y1 and y2 with a target. Level 1: y0 + y4 = 4. Level 2: a
// target for y3.
class ZeroRoundingTest : public testing::Test {
 protected:
  // Returns y after rounding entries of `row` were set to zero.
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
    EqualityBlock last = hierarchy.AddEqualities(2, 1);
    last.B << 0, 0, 0, 1, 0;
    last.b << -kTarget;
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

// An entry that is rounding of the largest entry becomes zero if the row
// contains it. An entry of 1e-12 of the largest entry, or more, stays.
TEST_F(ZeroRoundingTest, ZeroesRoundingOfTheLargestEntry) {
  for (const double sign : {1., -1.}) {
    for (const double part : {1e-30, 1e-20, 1e-16, 1e-15}) {
      const double nothing = sign * part * kLarge;
      EXPECT_EQ(Take(1, 1, 7, {kLarge, nothing, 7, 0, 0}, {0, 2, 0, 0, 0})[1],
                0);
      // The row does not contain the entry.
      EXPECT_EQ(
          Take(1, 1, 4, {kLarge, nothing, kLarge, 0, 0}, {0, 0, 2, 1, 1})[1],
          nothing);
    }
    for (const double part : {1e-12, 1e-9, 1e-3}) {
      const double something = sign * part * kLarge;
      EXPECT_EQ(
          Take(1, 1, 4, {kLarge, something, kLarge, 0, 0}, {0, 2, 0, 0, 0})[1],
          something);
    }
  }
}

TEST_F(ZeroRoundingTest, KeepsEntriesThatARowNeeds) {
  const Vector y{kLarge, kSmall, 2 * kSmall, 0, 0};
  EXPECT_EQ(Take(1, 1, 3 * kSmall, y, {0, 1, 0, 0, 0}), y);
  EXPECT_EQ(Take(1, 1, 3 * kSmall, y, {0, 1, 1, 0, 0}), y);
  // Entries that are zero, at their target or not, do not matter.
  const Vector one{kLarge, 0, 3 * kSmall, 0, 0};
  EXPECT_EQ(Take(1, 1, 3 * kSmall, one, {0, 1, 1, 1, 0}), one);
  // Neither does a large entry that no other row contains.
  const Vector large{kLarge, 3 * kSmall, 0, 1, 0};
  EXPECT_EQ(Take(1, 1, 3 * kSmall, large, {0, 1, 0, 1, 0}), large);
}

TEST_F(ZeroRoundingTest, UsesTheResidualsOfTheCurrentY) {
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
  problem.SetSolution(hierarchy, {kLarge, 1, 1});  // Meets no row.
  problem.Solve(hierarchy, {{}, {}});
  const Vector row{0, 1, 0};
  EXPECT_FALSE(problem.ZeroRoundingEntries(hierarchy, row.data()));
  EXPECT_EQ(problem.y(), y);
}

// y1 = 0 would violate y1 = 1, but that bound is no longer active.
TEST_F(ZeroRoundingTest, IgnoresRowsThatAreNotActive) {
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

TEST_F(ZeroRoundingTest, ZeroesTwoEntriesThatCancel) {
  const Vector y{kLarge, kSmall, kSmall, 0, 0};
  EXPECT_EQ(Take(1, -1, 0, y, {0, 1, 1, 0, 0}), Vector({kLarge, 0, 0, 0, 0}));
  // The row may contain only one of them.
  EXPECT_EQ(Take(1, -1, 0, y, {0, 1, 0, 0, 0}), Vector({kLarge, 0, 0, 0, 0}));
  EXPECT_EQ(Take(1, -1, 0, y, {1, 0, 0, 1, 1}), y);
}

// An entry of 1e-30 does not change a residual of a target of 1e-15.
TEST_F(ZeroRoundingTest, ZeroesOneEntryWhereTheOtherIsNeeded) {
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

// The relative residual of a row may double: from 0.43 to 0.54 of its terms,
// not from 0.053 to 0.14.
TEST_F(ZeroRoundingTest, AllowsAResidualToDouble) {
  const auto take = [&](double y1, double y2, double target) {
    return Take(1, 1, target * kSmall, {kLarge, y1 * kSmall, y2 * kSmall, 0, 0},
                {0, 1, 0, 0, 0})[1];
  };
  EXPECT_EQ(take(0.2, 0.6, 2), 0);
  EXPECT_EQ(take(0.15, 0.75, 1), 0.15 * kSmall);
}

TEST_F(ZeroRoundingTest, KeepsEntriesAtTheirTarget) {
  const auto take = [&](double y3) {
    return Take(1, 1, 4, {kLarge, 0, kLarge, y3, 0}, {0, 0, 0, 1, 0})[3];
  };
  EXPECT_EQ(take(kTarget), kTarget);
  EXPECT_EQ(take(-kTarget), 0);
  const double nearly = kTarget * (1 + 1e-15);  // A few eps.
  EXPECT_EQ(take(nearly), nearly);
  EXPECT_EQ(take(kTarget * (1 + 1e-11)), 0);
  EXPECT_EQ(take(kTarget / 2), 0);
  EXPECT_EQ(take(2 * kTarget), 0);
}

}  // namespace
}  // namespace poise
