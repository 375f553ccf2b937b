// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The reference where something is at an edge, or within rounding of it.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/math/rank.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/solve_cascade.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-14;  // A few operations on numbers near 1.

class CascadeByHandTest : public testing::TestWithParam<RowSpaceMethod> {};

double WorstOf(const HierarchyCase& drawn, const Solution& solution) {
  return Certifier(drawn.hierarchy.num_variables(), drawn.capacity)
      .Certify(drawn.hierarchy, solution)
      .worst();
}

// 3 y0 + 4 y1 <= 50 and >= 50 plus twice a violation, at y = (10, 5). The rows are
// violated beyond 1e-9 (5 |y| + 50), and take one from the nullity then.
TEST_P(CascadeByHandTest, CountsViolatedRowsInTheNullity) {
  for (const double share : {0.01, 100.}) {
    HierarchyCase edge{{{1, 2}}, Hierarchy(2, {{1, 2}})};
    EqualityBlock across = edge.hierarchy.AddEqualities(0, 1);
    across.B << -4, 3;
    across.b << 25;
    InequalityBlock rows = edge.hierarchy.AddInequalities(0, 2);
    rows.C << 3, 4, 3, 4;
    rows.upper[0] = 50;
    rows.lower[1] = 50 + 2 * share * 1e-9 * (5 * std::sqrt(125) + 50);
    const Solution solution = SolveCascade(edge, GetParam());
    // Between the two bounds, along (3, 4) / 5.
    EXPECT_LE((solution.y - Eigen::Vector2d(10, 5)).norm(),
              (rows.lower[1] - 50) / 5);
    EXPECT_LE(solution.certificate.worst(), 1e-9);
    EXPECT_EQ(solution.levels[0].nullity, share < 1 ? 1 : 0);
  }
}

// y = (1, 2) above 3 y0 = 3 with weight 2, missed by a little, and y0 + 2 y1
// within 5, missed by a little: gradients are relative to (36 + 5, 10).
TEST_P(CascadeByHandTest, AsksForNothingWhereALevelIsMet) {
  for (const double share : {0.01, 100.}) {
    for (const Side side : {Side::kLower, Side::kUpper}) {
      SCOPED_TRACE(testing::Message() << share << static_cast<int>(side));
      const double sign = static_cast<double>(side);
      const std::vector<LevelCapacity> capacity{{2, 0}, {1, 2}};
      HierarchyCase met{capacity, Hierarchy(2, capacity)};
      EqualityBlock fixed = met.hierarchy.AddEqualities(0, 2);
      fixed.B.setIdentity();
      fixed.b << -1, -2;
      const double size = 1e-12 * std::hypot(41, 10) * share;
      const double slack = 0.3 * size;
      const double residual =
          sign * (std::sqrt(size * size - 4 * slack * slack) - slack) / 6;
      EqualityBlock missed = met.hierarchy.AddEqualities(1, 1);
      missed.B << 3, 0;
      missed.b << -3 + residual;
      missed.weight << 2;
      // A row that is not violated takes no part.
      met.hierarchy.AddInequalities(1, 1).C << 100, 100;
      InequalityBlock row = met.hierarchy.AddInequalities(1, 1);
      row.C << 1, 2;
      (side == Side::kLower ? row.lower : row.upper) << 5 - sign * slack;
      const Eigen::VectorXd multipliers =
          SolveCascade(met, GetParam()).levels[1].multipliers[0].equality;
      if (share < 1) {
        EXPECT_EQ(multipliers, Eigen::Vector2d(0, 0));
      } else {
        EXPECT_NEAR(multipliers[0], -6 * residual - sign * slack, kTolerance);
        EXPECT_NEAR(multipliers[1], -2 * sign * slack, kTolerance);
      }
    }
  }
}

// y = 1 above y <= 0 and y >= 2, but for a little of 1 + 1 from each of these.
TEST_P(CascadeByHandTest, AsksForNothingWhereRowsDrawAlike) {
  for (const double share : {0.01, 100.}) {
    const double off = 2e-12 * share;
    const std::vector<LevelCapacity> capacity{{1, 0}, {0, 2}};
    HierarchyCase torn{capacity, Hierarchy(1, capacity)};
    EqualityBlock fixed = torn.hierarchy.AddEqualities(0, 1);
    fixed.B << 1;
    fixed.b << -(1 + off);
    InequalityBlock rows = torn.hierarchy.AddInequalities(1, 2);
    rows.C << 1, 1;
    rows.upper[0] = 0;
    rows.lower[1] = 2;
    const Solution solution = SolveCascade(torn, GetParam());
    // Of a difference of ones.
    EXPECT_NEAR(solution.levels[1].multipliers[0].equality[0],
                share < 1 ? 0 : -2 * off, Rounding(1, 4));
  }
}

// y >= 1 and y <= -1, then <= 5: what was violated need not be any more.
TEST_P(CascadeByHandTest, ForgetsWhichRowsWereViolated) {
  const std::vector<LevelCapacity> capacity{{0, 2}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock rows = hierarchy.AddInequalities(0, 2);
  rows.C << 1, 1;
  rows.lower[0] = 1;
  Cascade cascade(1, capacity, GetParam());
  Solution solution(1, capacity);
  for (const double upper : {-1., 5.}) {
    rows.upper[1] = upper;
    EXPECT_EQ(cascade.Solve(hierarchy, &solution), Status::kOptimal) << upper;
    EXPECT_NEAR(solution.y[0], upper < 0 ? 0 : 1, kTolerance);
  }
}

// y0 is 8 times the other one's unit: its rounding is not to be asked about.
TEST_P(CascadeByHandTest, TakesRoundingForZero) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}};
  HierarchyCase two{capacity, Hierarchy(2, capacity)};
  EqualityBlock both = two.hierarchy.AddEqualities(0, 1);
  both.B << 0.87, 0.18;
  both.b << 7;
  both.weight << 2.6;
  two.hierarchy.AddEqualities(1, 1).B << 0, 1;
  const Solution solution = SolveCascade(two, GetParam());
  EXPECT_NEAR(solution.y[0], -7 / 0.87, 10 * kTolerance);
  EXPECT_EQ(solution.y[1], 0);
  EXPECT_LE(WorstOf(two, solution), kTolerance);
}

// No more than that: an entry a thousand times the rounding is one.
TEST_P(CascadeByHandTest, TakesASmallEntryForWhatItIs) {
  for (const double small : {1e-12, 1e-16}) {
    HierarchyCase two{{{2, 0}}, Hierarchy(2, {{2, 0}})};
    EqualityBlock wishes = two.hierarchy.AddEqualities(0, 2);
    wishes.B.setIdentity();
    wishes.b << -8, -small;
    EXPECT_EQ(SolveCascade(two, GetParam()).y[1], small == 1e-12 ? small : 0);
  }
}

// y0 = -1 below 3 y0 + 2 y1 <= 0 and 2 y0 + y1 >= 0, which leave only zero:
// (1, 0) + (3, 2) - 2 (2, 1) = 0, without any help of y1 = 0, which weighs
// nothing.
TEST_P(CascadeByHandTest, LeavesARowWithoutWeightWithoutMultiplier) {
  const std::vector<LevelCapacity> capacity{{1, 2}, {1, 0}};
  HierarchyCase corner{capacity, Hierarchy(2, capacity)};
  EqualityBlock nothing = corner.hierarchy.AddEqualities(0, 1);
  nothing.B << 0, -1;
  nothing.weight << 0;
  InequalityBlock rows = corner.hierarchy.AddInequalities(0, 2);
  rows.C << 3, 2, -2, -1;
  rows.upper << 0, 0;
  EqualityBlock wish = corner.hierarchy.AddEqualities(1, 1);
  wish.B << 1, 0;
  wish.b << 1;
  const Solution solution = SolveCascade(corner, GetParam());
  EXPECT_EQ(solution.y, Eigen::Vector2d(0, 0));
  EXPECT_EQ(solution.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution.levels[0].active[1], Side::kUpper);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_EQ(multipliers.equality[0], 0);
  EXPECT_NEAR(multipliers.inequality[0], 1, kTolerance);
  EXPECT_NEAR(multipliers.inequality[1], 2, kTolerance);
}

// A row of one bound for both sides, crossed while it was active, and other rows
// in the way at once when it leaves; and the same upside down.
TEST_P(CascadeByHandTest, KeepsARowThatHasCrossedBothItsBounds) {
  for (const double sign : {1., -1.}) {
    const std::vector<LevelCapacity> capacity{{2, 5}, {3, 1}};
    HierarchyCase crossed{capacity, Hierarchy(6, capacity)};
    EqualityBlock above = crossed.hierarchy.AddEqualities(0, 2);
    above.B << -3, 0, 0, 0, 0, -2,  //
        0, 0, 1, 0, 0, 0;
    above.b << 0, 3;
    above.weight << 1, 2.08;
    InequalityBlock bounds = crossed.hierarchy.AddInequalities(0, 5);
    bounds.C << 0, 0, 1, 0, 0, 0,      //
        0, -0.71, 0, -0.17, 0, -1.65,  //
        0, 0, 0, -2, -2, 3,            //
        0, -1.61, 0, 0, 0, 0,          //
        0, 0, 0, -2.52, 0, 2;
    bounds.lower.head(3) << 2, 1.881, -1;
    bounds.upper.tail(2) << -3, 3;
    EqualityBlock below = crossed.hierarchy.AddEqualities(1, 3);
    below.B << -0.51, 3, 0, 1, -0.71, -1,  //
        0, -0.71, 0, -0.17, 0, -1.65,      //
        0, 0, -3, 0, 0, 0.68;
    below.b << 4, -1, 7;
    below.weight << 1, 2.75, 1;
    InequalityBlock row = crossed.hierarchy.AddInequalities(1, 1);
    row.C << 0, 0, 0.28 * sign, 0, 0, -3 * sign;
    row.lower << 5 * sign;
    row.upper << 5 * sign;
    const Solution solution = SolveCascade(crossed, GetParam());
    EXPECT_EQ(solution.levels[1].active[0],
              sign > 0 ? Side::kLower : Side::kUpper);
    EXPECT_LE(WorstOf(crossed, solution), kTolerance);
  }
}

// Once all of a level is met, multipliers are rounding, and no row leaves for them.
TEST_P(CascadeByHandTest, EndsWhereALevelIsMet) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 2}};
  HierarchyCase met{capacity, Hierarchy(3, capacity)};
  InequalityBlock bounds = met.hierarchy.AddInequalities(0, 2);
  bounds.C << 0, -0.84, 0,  //
      -2.83, -0.08, 0;
  bounds.lower[0] = 0.588;
  bounds.upper[1] = -3.3683;
  EqualityBlock wish = met.hierarchy.AddEqualities(1, 1);
  wish.B << 1, 0, 0;
  wish.b << -1.21;
  InequalityBlock rows = met.hierarchy.AddInequalities(1, 2);
  rows.C << 1, 0.38, 2,  //
      0, 2, -2.81;
  rows.upper[0] = -2;
  rows.lower[1] = 0;
  const Solution solution = SolveCascade(met, GetParam());
  EXPECT_NEAR(solution.levels[1].cost, 0, kTolerance);
  EXPECT_LE(WorstOf(met, solution), kTolerance);
}

// y0 = 1 above y0 <= -1, y0 >= 3 and y1 >= 2: nothing is left of the first two, so
// they are in no QP, but they are violated all the same; the last is met.
TEST_P(CascadeByHandTest, KnowsTheSideOfAViolatedRowOfWhichNothingIsLeft) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {0, 3}, {2, 0}};
  HierarchyCase fixed{capacity, Hierarchy(2, capacity)};
  EqualityBlock one = fixed.hierarchy.AddEqualities(0, 1);
  one.B << 1, 0;
  one.b << -1;
  InequalityBlock rows = fixed.hierarchy.AddInequalities(1, 3);
  rows.C << 1, 0, 1, 0, 0, 1;
  rows.upper[0] = -1;
  rows.lower.tail(2) << 3, 2;
  EqualityBlock wish = fixed.hierarchy.AddEqualities(2, 2);
  wish.B.setIdentity();
  wish.b << 0, -5;
  const Solution solution = SolveCascade(fixed, GetParam());
  EXPECT_LE((solution.y - Eigen::Vector2d(1, 5)).norm(), Rounding(5, 2));
  EXPECT_EQ(solution.levels[1].active[0], Side::kUpper);
  EXPECT_EQ(solution.levels[1].active[1], Side::kLower);
  EXPECT_EQ(solution.levels[1].active[2], Side::kNone);
}

// What the levels above leave of a row is judged by what it was before.
TEST_P(CascadeByHandTest, DropsARowOfWhichNothingIsLeft) {
  for (const double rest : {0.9e-11, 1.1e-11}) {
    const std::vector<LevelCapacity> capacity{{1, 0}, {0, 1}};
    HierarchyCase dropped{capacity, Hierarchy(2, capacity)};
    dropped.hierarchy.AddEqualities(0, 1).B << 1, 0;
    InequalityBlock row = dropped.hierarchy.AddInequalities(1, 1);
    row.C << 4, 4 * rest;
    row.upper << -4;
    const Solution solution = SolveCascade(dropped, GetParam());
    EXPECT_EQ(solution.levels[1].active[0], Side::kUpper);
    EXPECT_EQ(solution.y[1] == 0, rest < kRankTolerance);
  }
}

// However short a row is, it says what it says; unless it is of no length.
TEST_P(CascadeByHandTest, TakesShortRowsLikeLongOnes) {
  const double length = std::ldexp(1, -43);  // 1e-13.
  const std::vector<LevelCapacity> capacity{{3, 1}, {3, 0}};
  HierarchyCase drawn{capacity, Hierarchy(3, capacity)};
  EqualityBlock rows = drawn.hierarchy.AddEqualities(0, 3);
  rows.B << length, 0, 0, 0, 4, 0, 0, 0, 0;
  rows.b << -length, -4, 0;
  InequalityBlock bound = drawn.hierarchy.AddInequalities(0, 1);
  bound.C << 0, 0, length;
  bound.upper << length;
  EqualityBlock wishes = drawn.hierarchy.AddEqualities(1, 3);
  wishes.B.setIdentity();
  wishes.b << -2, -3, -4;
  const Solution solution = SolveCascade(drawn, GetParam());
  EXPECT_LE((solution.y - Eigen::Vector3d(1, 1, 1)).norm(), kTolerance);
  EXPECT_EQ(solution.levels[0].nullity, 1);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_NEAR(multipliers.equality[0] * length, 1, kTolerance);
  EXPECT_NEAR(multipliers.equality[1] * 4, 2, kTolerance);
  EXPECT_EQ(multipliers.equality[2], 0);
  EXPECT_NEAR(multipliers.inequality[0] * length, 3, kTolerance);
}

TEST_P(CascadeByHandTest, TakesARowWithoutWeightForNone) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {2, 0}};
  HierarchyCase weightless{capacity, Hierarchy(2, capacity)};
  EqualityBlock rows = weightless.hierarchy.AddEqualities(0, 2);
  rows.B << 1, 1, 1, 0;
  rows.b << -9, -3;
  rows.weight << 0, 1;
  EqualityBlock below = weightless.hierarchy.AddEqualities(1, 2);
  below.B.setIdentity();
  below.b << -8, -5;
  const Solution solution = SolveCascade(weightless, GetParam());
  EXPECT_LE((solution.y - Eigen::Vector2d(3, 5)).norm(), kTolerance);
  EXPECT_EQ(solution.levels[0].nullity, 1);
  EXPECT_EQ(solution.levels[1].nullity, 0);
}

// Two rows that are one, but for rounding, share what is asked of them.
TEST_P(CascadeByHandTest, SharesMultipliersAmongRowsThatAreOne) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {2, 0}};
  HierarchyCase twice{capacity, Hierarchy(2, capacity)};
  EqualityBlock rows = twice.hierarchy.AddEqualities(0, 2);
  rows.B << 1, 0, 1, 1e-13;
  rows.b << -1, -1;
  EqualityBlock wishes = twice.hierarchy.AddEqualities(1, 2);
  wishes.B.setIdentity();
  wishes.b << -3, -5;
  const Solution solution = SolveCascade(twice, GetParam());
  EXPECT_EQ(solution.levels[0].nullity, 1);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_NEAR(multipliers.equality[0], 1, 1e-10);  // 1e-13 of 5, and rounding.
  EXPECT_NEAR(multipliers.equality[1], 1, 1e-10);
}

// Of all y, the shortest; and still above what the rows allow.
TEST_P(CascadeByHandTest, TakesTheShortestOfManyOptima) {
  HierarchyCase free{{{1, 1}}, Hierarchy(3, {{1, 1}})};
  EqualityBlock sum = free.hierarchy.AddEqualities(0, 1);
  sum.B << 1, 1, 0;
  sum.b << -2;
  InequalityBlock bound = free.hierarchy.AddInequalities(0, 1);
  bound.C << 1, 0, 0;
  bound.lower << 0.5;
  EXPECT_LE(
      (SolveCascade(free, GetParam()).y - Eigen::Vector3d(1, 1, 0)).norm(),
      kTolerance);
  bound.lower << 1.5;
  EXPECT_LE(
      (SolveCascade(free, GetParam()).y - Eigen::Vector3d(1.5, 0.5, 0)).norm(),
      kTolerance);
}

// y0 + y1 + y2 = 500 above y1 and y2 of 1e-6: what rounding of 500 leaves of
// these the first time, the second takes away.
TEST_P(CascadeByHandTest, IsAsExactWhereNumbersAreSmall) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}, {1, 0}};
  HierarchyCase small{capacity, Hierarchy(3, capacity)};
  EqualityBlock sum = small.hierarchy.AddEqualities(0, 1);
  sum.B << 1, 1, 1;
  sum.b << -500;
  const Eigen::Vector3d rows[] = {{0, 1, 0}, {0, 0, 1}};
  for (int level : {1, 2}) {
    EqualityBlock one = small.hierarchy.AddEqualities(level, 1);
    one.B = rows[level - 1].transpose();
    one.b << -1e-6 * level;
  }
  const Solution solution = SolveCascade(small, GetParam());
  EXPECT_LE(WorstOf(small, solution), Certifier::kCertified);
  for (int level : {1, 2}) {
    EXPECT_NEAR(solution.y[level], 1e-6 * level, Rounding(1e-6, 3));
  }
  EXPECT_EQ(solution.iterations, 8);  // Three levels and the norm, twice.
}

// Two large rows of one direction conflict, beside a small one across them that
// is met: to rounding of its own, not of theirs.
TEST_P(CascadeByHandTest, MeetsASmallRowBesideAConflict) {
  for (int place = 0; place < 3; ++place) {
    for (const double factor : {1.0, -2.0}) {
      HierarchyCase conflict{{{3, 0}}, Hierarchy(2, {{3, 0}})};
      EqualityBlock rows = conflict.hierarchy.AddEqualities(0, 3);
      for (int i = 0; i < 3; ++i) rows.B.row(i) << 28400, 17700;
      rows.B.row(place) << 0, 0.0052;
      const int last = place == 2 ? 1 : 2;
      rows.B.row(last) *= factor;
      rows.b[last] = 53392;
      const Solution solution = SolveCascade(conflict, GetParam());
      EXPECT_NEAR(solution.y[0],
                  -53392 * factor / (1 + factor * factor) / 28400,
                  Rounding(1, 3));
      EXPECT_NEAR(solution.y[1], 0, Rounding(1, 3)) << place;
    }
  }
}

// All rows are met at integers, most of them just so. Once a level is there, what
// its rows lack is rounding, for which they leave, and are in the way at once:
// by SVD in the first of these, by COD in the second.
TEST_P(CascadeByHandTest, EndsWhereRowsComeAndGoForRounding) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 5}};
  HierarchyCase five{capacity, Hierarchy(5, capacity)};
  EqualityBlock sum = five.hierarchy.AddEqualities(0, 1);
  sum.B << 0, -5, 5, 1, 4;
  sum.b << -25;
  InequalityBlock bound = five.hierarchy.AddInequalities(0, 1);
  bound.C << -2, -5, 1, -1, -5;
  bound.upper << 0;
  EqualityBlock wish = five.hierarchy.AddEqualities(1, 1);
  wish.B << 3, -1, 5, -2, -1;
  wish.b << -3;
  InequalityBlock rows = five.hierarchy.AddInequalities(1, 5);
  rows.C << -1, -1, 0, -2, 5,  //
      1, -4, 1, -1, 2,         //
      -2, -2, 0, 2, 0,         //
      5, 5, -1, -2, -5,        //
      2, 3, -5, -3, -3;
  rows.upper.head(4) << 23, 11, 4, -33;
  rows.lower[4] = -22;
  Eigen::VectorXd optimum(5);
  optimum << -3, -1, 2, -2, 3;
  EXPECT_LE((SolveCascade(five, GetParam()).y - optimum).norm(),
            Rounding(optimum.norm(), 5));

  const std::vector<LevelCapacity> more{{1, 3}, {0, 5}};
  HierarchyCase four{more, Hierarchy(4, more)};
  EqualityBlock plane = four.hierarchy.AddEqualities(0, 1);
  plane.B << -2, -4, -2, -3;
  plane.b << -3;
  InequalityBlock above = four.hierarchy.AddInequalities(0, 3);
  above.C << 2, -5, -4, 1,  //
      2, -5, 3, -4,         //
      -1, 3, 1, 5;
  above.lower << -16, -4, 2;
  InequalityBlock below = four.hierarchy.AddInequalities(1, 5);
  below.C << 0, 0, -5, 1,  //
      -4, 0, -2, -2,       //
      1, 1, 1, 0,          //
      -3, -5, 3, -3,       //
      -5, -2, -3, -5;
  below.lower << -6, -INFINITY, -1, -INFINITY, 15;
  below.upper << INFINITY, 12, INFINITY, 10, INFINITY;
  EXPECT_LE(
      (SolveCascade(four, GetParam()).y - Eigen::Vector4d(-3, 1, 1, -1)).norm(),
      Rounding(4, 4));
}

INSTANTIATE_TEST_SUITE_P(BothWays, CascadeByHandTest,
                         testing::Values(RowSpaceMethod::kSvd,
                                         RowSpaceMethod::kCod));

}  // namespace
}  // namespace poise
