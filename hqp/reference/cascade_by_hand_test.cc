// Tests the reference at degenerate points, and with numbers that are zero to
// rounding.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

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

// Level 0: 3 y0 + 4 y1 <= 50 and >= 50 + conflict, with the optimum near y =
// (10, 5). Level 1: the target y = 0. y stays between the two bounds. A
// violated row is an equality for the levels below, and counts in the nullity.
// A row that is violated by rounding only does not.
TEST_P(CascadeByHandTest, TreatsViolatedRowsAsEqualitiesOfLowerLevels) {
  for (const double conflict : {1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-2, 1.}) {
    SCOPED_TRACE(conflict);
    const std::vector<LevelCapacity> capacity{{1, 2}, {2, 0}};
    HierarchyCase edge{capacity, Hierarchy(2, capacity)};
    EqualityBlock across = edge.hierarchy.AddEqualities(0, 1);
    across.B << -4, 3;
    across.b << 25;
    InequalityBlock rows = edge.hierarchy.AddInequalities(0, 2);
    rows.C << 3, 4, 3, 4;
    rows.upper[0] = 50;
    rows.lower[1] = 50 + conflict;
    edge.hierarchy.AddEqualities(1, 2).B.setIdentity();
    const Solution solution = SolveCascade(edge, GetParam());
    // Between the two bounds, along (3, 4) / 5.
    EXPECT_LE((solution.y - Eigen::Vector2d(10, 5)).norm(),
              conflict / 5 + Rounding(12, 2, 5));
    EXPECT_LE(solution.certificate.worst(), Certifier::kCertified);
    if (conflict <= 1e-9) {
      EXPECT_EQ(solution.levels[0].nullity, 1);
    }
    if (conflict >= 1e-5) {
      EXPECT_EQ(solution.levels[0].nullity, 0);
    }
  }
}

// Level 0 fixes y = (1, 2). Level 1: 3 y0 = 3 with weight 2, missed by
// `residual`, and a bound on y0 + 2 y1, violated by `slack`. The gradient is
// relative to (36 + 5, 10). Each multiplier is exact to kNegligible of that.
TEST_P(CascadeByHandTest, FindsTheMultipliersOfSmallResiduals) {
  for (const double part : {1e-16, 1e-14, 1e-10, 1e-6, 1e-2}) {
    for (const Side side : {Side::kLower, Side::kUpper}) {
      SCOPED_TRACE(testing::Message() << part << static_cast<int>(side));
      const double sign = static_cast<double>(side);
      const std::vector<LevelCapacity> capacity{{2, 0}, {1, 2}};
      HierarchyCase met{capacity, Hierarchy(2, capacity)};
      EqualityBlock fixed = met.hierarchy.AddEqualities(0, 2);
      fixed.B.setIdentity();
      fixed.b << -1, -2;
      const double size = std::hypot(41, 10);
      const double slack = part * size, residual = sign * 2 * part * size;
      EqualityBlock missed = met.hierarchy.AddEqualities(1, 1);
      missed.B << 3, 0;
      missed.b << -3 + residual;
      missed.weight << 2;
      // A row that is not violated is not in the gradient.
      met.hierarchy.AddInequalities(1, 1).C << 100, 100;
      InequalityBlock row = met.hierarchy.AddInequalities(1, 1);
      row.C << 1, 2;
      (side == Side::kLower ? row.lower : row.upper) << 5 - sign * slack;
      const Solution solution = SolveCascade(met, GetParam());
      const Eigen::VectorXd multipliers =
          solution.levels[1].multipliers[0].equality;
      EXPECT_NEAR(multipliers[0], -6 * residual - sign * slack, 2e-12 * size);
      EXPECT_NEAR(multipliers[1], -2 * sign * slack, 2e-12 * size);
      if (part <= 1e-14) {
        EXPECT_EQ(multipliers, Eigen::Vector2d(0, 0));
      }
      EXPECT_LE(solution.certificate.worst(), Certifier::kCertified);
    }
  }
}

// Level 0: y = 1 + off. Level 1: y <= 0 and y >= 2, whose violations are equal
// at y = 1.
TEST_P(CascadeByHandTest, FindsTheMultiplierOfOpposedRows) {
  for (const double off : {0., 1e-16, 1e-14, 1e-10, 1e-6, 1e-2}) {
    const std::vector<LevelCapacity> capacity{{1, 0}, {0, 2}};
    HierarchyCase opposed{capacity, Hierarchy(1, capacity)};
    EqualityBlock fixed = opposed.hierarchy.AddEqualities(0, 1);
    fixed.B << 1;
    fixed.b << -(1 + off);
    InequalityBlock rows = opposed.hierarchy.AddInequalities(1, 2);
    rows.C << 1, 1;
    rows.upper[0] = 0;
    rows.lower[1] = 2;
    const Solution solution = SolveCascade(opposed, GetParam());
    // To kNegligible of 1 + 1 from each row. If `off` is rounding of these, the
    // multiplier is zero.
    EXPECT_NEAR(solution.levels[1].multipliers[0].equality[0],
                off <= 1e-14 ? 0 : -2 * off, off <= 1e-14 ? 0 : 8e-12)
        << off;
    EXPECT_LE(solution.certificate.worst(), Certifier::kCertified);
  }
}

// y >= 1 and y <= -1 in the first solve, y >= 1 and y <= 5 in the second. The
// second solve violates no row.
TEST_P(CascadeByHandTest, DoesNotKeepViolatedRowsOfTheLastSolve) {
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

// The step to y0 = -8 leaves rounding in y1. This rounding must become zero
// before the next level, y1 = 0, is solved.
TEST_P(CascadeByHandTest, SetsARoundingEntryToZero) {
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

// An entry of y that a row determines is exact, even if another entry is much
// larger. Only rounding of the largest entry of the step is set to zero.
TEST_P(CascadeByHandTest, KeepsASmallEntry) {
  for (const double small : {1e-13, 1e-9, 1e-6, 1e-3, 1.}) {
    HierarchyCase two{{{2, 0}}, Hierarchy(2, {{2, 0}})};
    EqualityBlock targets = two.hierarchy.AddEqualities(0, 2);
    targets.B.setIdentity();
    targets.b << -8, -small;
    EXPECT_EQ(SolveCascade(two, GetParam()).y[1], small);
  }
}

// Level 0: 3 y0 + 2 y1 <= 0, 2 y0 + y1 >= 0, and y1 = 0 with weight 0. Level 1:
// y0 = -1. The optimum is y = 0, where the gradients cancel: (1, 0) + (3, 2) -
// 2 (2, 1) = 0. The row of weight 0 has no multiplier.
TEST_P(CascadeByHandTest, GivesARowOfWeightZeroNoMultiplier) {
  const std::vector<LevelCapacity> capacity{{1, 2}, {1, 0}};
  HierarchyCase corner{capacity, Hierarchy(2, capacity)};
  EqualityBlock nothing = corner.hierarchy.AddEqualities(0, 1);
  nothing.B << 0, -1;
  nothing.weight << 0;
  InequalityBlock rows = corner.hierarchy.AddInequalities(0, 2);
  rows.C << 3, 2, -2, -1;
  rows.upper << 0, 0;
  EqualityBlock desired = corner.hierarchy.AddEqualities(1, 1);
  desired.B << 1, 0;
  desired.b << 1;
  const Solution solution = SolveCascade(corner, GetParam());
  EXPECT_EQ(solution.y, Eigen::Vector2d(0, 0));
  EXPECT_EQ(solution.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution.levels[0].active[1], Side::kUpper);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_EQ(multipliers.equality[0], 0);
  EXPECT_NEAR(multipliers.inequality[0], 1, kTolerance);
  EXPECT_NEAR(multipliers.inequality[1], 2, kTolerance);
}

// y crosses both equal bounds of a row while the row is active. When the row is
// removed, other rows block at the same y. With the second sign, the row is
// negated.
TEST_P(CascadeByHandTest, KeepsARowViolatedAcrossBothBounds) {
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

// The level is met, so its multipliers are rounding, and no row is removed.
TEST_P(CascadeByHandTest, EndsWhereALevelIsMet) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 2}};
  HierarchyCase met{capacity, Hierarchy(3, capacity)};
  InequalityBlock bounds = met.hierarchy.AddInequalities(0, 2);
  bounds.C << 0, -0.84, 0,  //
      -2.83, -0.08, 0;
  bounds.lower[0] = 0.588;
  bounds.upper[1] = -3.3683;
  EqualityBlock desired = met.hierarchy.AddEqualities(1, 1);
  desired.B << 1, 0, 0;
  desired.b << -1.21;
  InequalityBlock rows = met.hierarchy.AddInequalities(1, 2);
  rows.C << 1, 0.38, 2,  //
      0, 2, -2.81;
  rows.upper[0] = -2;
  rows.lower[1] = 0;
  const Solution solution = SolveCascade(met, GetParam());
  EXPECT_NEAR(solution.levels[1].cost, 0, kTolerance);
  EXPECT_LE(WorstOf(met, solution), kTolerance);
}

// Level 0: y0 = 1. Level 1: y0 <= -1, y0 >= 3 and y1 >= 2. The first two rows
// of level 1 depend on level 0 and are in no QP, but they are violated. The
// last row is met.
TEST_P(CascadeByHandTest, ReportsTheViolatedSideOfAFixedRow) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {0, 3}, {2, 0}};
  HierarchyCase fixed{capacity, Hierarchy(2, capacity)};
  EqualityBlock one = fixed.hierarchy.AddEqualities(0, 1);
  one.B << 1, 0;
  one.b << -1;
  InequalityBlock rows = fixed.hierarchy.AddInequalities(1, 3);
  rows.C << 1, 0, 1, 0, 0, 1;
  rows.upper[0] = -1;
  rows.lower.tail(2) << 3, 2;
  EqualityBlock desired = fixed.hierarchy.AddEqualities(2, 2);
  desired.B.setIdentity();
  desired.b << 0, -5;
  const Solution solution = SolveCascade(fixed, GetParam());
  EXPECT_LE((solution.y - Eigen::Vector2d(1, 5)).norm(), Rounding(5, 2));
  EXPECT_EQ(solution.levels[1].active[0], Side::kUpper);
  EXPECT_EQ(solution.levels[1].active[1], Side::kLower);
  EXPECT_EQ(solution.levels[1].active[2], Side::kNone);
}

// Level 0: y0 = 0. Level 1: 4 y0 + 4 rest y1 <= -4. If `rest` is rounding, y1
// does not become -1 / rest, and the row is violated. With any larger `rest`
// the row is met.
TEST_P(CascadeByHandTest, TreatsRoundingRemainderOfARowAsZero) {
  const auto solve = [](double rest) {
    const std::vector<LevelCapacity> capacity{{1, 0}, {0, 1}};
    HierarchyCase dependent{capacity, Hierarchy(2, capacity)};
    dependent.hierarchy.AddEqualities(0, 1).B << 1, 0;
    InequalityBlock row = dependent.hierarchy.AddInequalities(1, 1);
    row.C << 4, 4 * rest;
    row.upper << -4;
    const Solution solution = SolveCascade(dependent, GetParam());
    EXPECT_EQ(solution.levels[1].active[0], Side::kUpper) << rest;
    EXPECT_LE(solution.certificate.worst(), Certifier::kCertified) << rest;
    EXPECT_EQ(solution.y[0], 0) << rest;
    return solution.y[1];
  };
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  for (const double rest : {1e-30, kEps, 100 * kEps}) {
    EXPECT_EQ(solve(rest), 0) << rest;
  }
  for (const double rest : {1e-9, 1e-6, 1e-3, 1.}) {
    EXPECT_NEAR(solve(rest), -1 / rest, Rounding(1 / rest, 2)) << rest;
  }
}

// A row of norm 1e-13 has the same effect as one of norm 4. A row of zeros is
// ignored.
TEST_P(CascadeByHandTest, TreatsSmallNormRowsLikeLargeNormRows) {
  const double length = std::ldexp(1, -43);  // 1e-13.
  const std::vector<LevelCapacity> capacity{{3, 1}, {3, 0}};
  HierarchyCase drawn{capacity, Hierarchy(3, capacity)};
  EqualityBlock rows = drawn.hierarchy.AddEqualities(0, 3);
  rows.B << length, 0, 0, 0, 4, 0, 0, 0, 0;
  rows.b << -length, -4, 0;
  InequalityBlock bound = drawn.hierarchy.AddInequalities(0, 1);
  bound.C << 0, 0, length;
  bound.upper << length;
  EqualityBlock targets = drawn.hierarchy.AddEqualities(1, 3);
  targets.B.setIdentity();
  targets.b << -2, -3, -4;
  const Solution solution = SolveCascade(drawn, GetParam());
  EXPECT_LE((solution.y - Eigen::Vector3d(1, 1, 1)).norm(), kTolerance);
  EXPECT_EQ(solution.levels[0].nullity, 1);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_NEAR(multipliers.equality[0] * length, 1, kTolerance);
  EXPECT_NEAR(multipliers.equality[1] * 4, 2, kTolerance);
  EXPECT_EQ(multipliers.equality[2], 0);
  EXPECT_NEAR(multipliers.inequality[0] * length, 3, kTolerance);
}

TEST_P(CascadeByHandTest, IgnoresARowWithoutWeight) {
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

// Two rows that are equal to rounding share the multiplier.
TEST_P(CascadeByHandTest, SharesAMultiplierBetweenEqualRows) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {2, 0}};
  HierarchyCase twice{capacity, Hierarchy(2, capacity)};
  EqualityBlock rows = twice.hierarchy.AddEqualities(0, 2);
  rows.B << 1, 0, 1, 1e-13;
  rows.b << -1, -1;
  EqualityBlock targets = twice.hierarchy.AddEqualities(1, 2);
  targets.B.setIdentity();
  targets.b << -3, -5;
  const Solution solution = SolveCascade(twice, GetParam());
  EXPECT_EQ(solution.levels[0].nullity, 1);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_NEAR(multipliers.equality[0], 1, 1e-10);  // 1e-13 of 5, and rounding.
  EXPECT_NEAR(multipliers.equality[1], 1, 1e-10);
}

// The cascade returns the optimum of minimum norm, without and with an active
// bound.
TEST_P(CascadeByHandTest, ReturnsTheMinimumNormSolution) {
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

// Level 0: y0 + y1 + y2 = 500. Levels 1 and 2: y1 = 1e-6 and y2 = 2e-6. The
// first pass leaves rounding of 500 in y1 and y2. The second pass corrects it.
TEST_P(CascadeByHandTest, SolvesSmallTargetsBesideLargeOnes) {
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

// Two parallel large-norm rows conflict. A small-norm row of another direction
// is met to rounding of its own terms.
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

// All rows are met at a point of integers, most of them at their bound. At the
// optimum the residuals are rounding. Without a limit, this rounding makes the
// search remove and add rows for ever: by SVD in the first example, by COD in
// the second.
TEST_P(CascadeByHandTest, EndsWhereMultipliersAreRounding) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 5}};
  HierarchyCase five{capacity, Hierarchy(5, capacity)};
  EqualityBlock sum = five.hierarchy.AddEqualities(0, 1);
  sum.B << 0, -5, 5, 1, 4;
  sum.b << -25;
  InequalityBlock bound = five.hierarchy.AddInequalities(0, 1);
  bound.C << -2, -5, 1, -1, -5;
  bound.upper << 0;
  EqualityBlock desired = five.hierarchy.AddEqualities(1, 1);
  desired.B << 3, -1, 5, -2, -1;
  desired.b << -3;
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

// In the nullspace of level 0, both rows of level 1 are within rounding of
// zero, each by itself, but not together. The level then has no step.
TEST_P(CascadeByHandTest, TakesNoStepAlongRowsThatAreRounding) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 1}};
  HierarchyCase drawn{capacity, Hierarchy(3, capacity)};
  EqualityBlock plane = drawn.hierarchy.AddEqualities(0, 1);
  plane.B << 1520, -9e-7, 55000;
  InequalityBlock above = drawn.hierarchy.AddInequalities(0, 1);
  above.C << 1410, -1.88e-6, -65000;
  above.lower << 0;
  EqualityBlock target = drawn.hierarchy.AddEqualities(1, 1);
  target.B << 1040, -9.4e-7, -84000;
  target.b << 5;
  InequalityBlock opposed = drawn.hierarchy.AddInequalities(1, 1);
  opposed.C << 0, 0, -176000;
  opposed.lower << 2;
  const Solution solution = SolveCascade(drawn, GetParam());
  EXPECT_LE(WorstOf(drawn, solution), Certifier::kCertified);
  // y is 0 to rounding, so level 1 misses 5 and 2.
  EXPECT_NEAR(solution.levels[1].cost, (25 + 4) / 2.,
              Certifier::kCertified * 29 / 2);
}

INSTANTIATE_TEST_SUITE_P(BothWays, CascadeByHandTest,
                         testing::Values(RowSpaceMethod::kSvd,
                                         RowSpaceMethod::kCod));

}  // namespace
}  // namespace poise
