// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of a path on which a blocking row depends on rows of the working set.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/path_between.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-13;  // A few operations on numbers near 1.

// y_2 = 0, x <= 1, y_1 <= 1 and lower <= x + y_1 + y_2 <= upper, where x is y_0
// or, if it is mirrored, -y_0. Below them, a target for x and y_1, which are
// both beyond their bounds.
class ExchangeTest : public testing::TestWithParam<bool> {
 protected:
  Hierarchy At(double upper, double target_0, double target_1,
               double lower = -kInfinity) const {
    Hierarchy hierarchy(3, capacity_);
    EqualityBlock zero = hierarchy.AddEqualities(0, 1);
    zero.B << 0, 0, 2;
    zero.b << 0;
    InequalityBlock bounds = hierarchy.AddInequalities(0, 3);
    bounds.C << 1, 0, 0, 0, 1, 0, sign_, 1, 1;
    bounds.lower << (GetParam() ? -1 : -kInfinity), -kInfinity, lower;
    bounds.upper << (GetParam() ? kInfinity : 1), 1, upper;
    EqualityBlock task = hierarchy.AddEqualities(1, 2);
    task.B << sign_, 1, 0, sign_, -1, 0;
    task.b << -target_0 - target_1, target_1 - target_0;
    return hierarchy;
  }
  double x(const PathBetween& search) const { return sign_ * search.y()[0]; }
  Side bound_of_x() const { return GetParam() ? Side::kLower : Side::kUpper; }

  const double sign_ = GetParam() ? -1 : 1;
  const std::vector<LevelCapacity> capacity_{{1, 3}, {2, 0}};
  PathBetween search_{3, capacity_};
};
INSTANTIATE_TEST_SUITE_P(Mirrored, ExchangeTest, testing::Bool());

// y is at the corner x = y_1 = 1, and violates the new bound of the sum, which
// blocks at once. The multipliers of x and y_1 are twice the distances to the
// target. The bound of the nearer target is replaced, and y goes on along the
// other one.
TEST_P(ExchangeTest, ReplacesTheRowWhoseMultiplierVanishesFirst) {
  for (const bool x_is_nearer : {true, false}) {
    SCOPED_TRACE(x_is_nearer);
    PathBetween search(3, capacity_);
    const auto at = [&](double upper) {
      return x_is_nearer ? At(upper, 3, 4) : At(upper, 4, 3);
    };
    search.Begin(at(3));
    const Hierarchy end = at(1.5);
    EXPECT_FALSE(search.Follow(end, 0));
    EXPECT_EQ(search.side()[0][0], x_is_nearer ? Side::kNone : bound_of_x());
    EXPECT_EQ(search.side()[0][1], x_is_nearer ? Side::kUpper : Side::kNone);
    EXPECT_EQ(search.side()[0][2], Side::kUpper);
    EXPECT_NEAR(x(search), 1, kTolerance);
    EXPECT_NEAR(search.y()[1], 1, kTolerance);
    EXPECT_TRUE(search.Follow(end, 0));
    EXPECT_NEAR(x(search), x_is_nearer ? 0.5 : 1, kTolerance);
    EXPECT_NEAR(search.y()[1], x_is_nearer ? 1 : 0.5, kTolerance);
  }
}

// After the exchange, the multiplier of x is 6 - 4 = 2. It decreases by twice
// the way of y_1, and is zero at x = 1, y_1 = 0. From then on, both decrease.
TEST_P(ExchangeTest, ReducesTheOtherMultipliers) {
  search_.Begin(At(3, 4, 3));
  const Hierarchy end = At(0, 4, 3);
  EXPECT_FALSE(search_.Follow(end, 1));
  EXPECT_EQ(search_.side()[0][0], Side::kNone);
  EXPECT_NEAR(x(search_), 1, 10 * kTolerance);
  EXPECT_NEAR(search_.y()[1], 0, 10 * kTolerance);
  EXPECT_TRUE(search_.Follow(end));
  EXPECT_NEAR(x(search_), 0.5, 10 * kTolerance);
  EXPECT_NEAR(search_.y()[1], -0.5, 10 * kTolerance);
}

// The multiplier of x is 4, and the sum gets it. At x = 0.5, where the path
// would end, it is -0.4, if the sum is not divided by its length. So it is
// zero, and the sum is removed, after 4 / 4.4 of the path.
TEST_P(ExchangeTest, GivesTheAddedRowItsMultiplier) {
  search_.Begin(At(3, 3, 4));
  const Hierarchy end = At(1.5, 0.3, 4);
  EXPECT_FALSE(search_.Follow(end, 1));
  EXPECT_EQ(search_.side()[0][0], Side::kNone);
  EXPECT_EQ(search_.side()[0][2], Side::kNone);
  EXPECT_NEAR(x(search_), 1 - 0.5 * 4 / 4.4, 10 * kTolerance);
  EXPECT_TRUE(search_.Follow(end));
  EXPECT_NEAR(x(search_), 0.3, 10 * kTolerance);
}

// A row that contradicts the others does not replace one of them.
TEST_P(ExchangeTest, AddsARowThatCannotBeMet) {
  search_.Begin(At(9, 4, 3, 1));
  EXPECT_FALSE(search_.Follow(At(9, 4, 3, 3), 0));
  EXPECT_EQ(search_.side()[0][0], bound_of_x());
  EXPECT_EQ(search_.side()[0][1], Side::kUpper);
  EXPECT_EQ(search_.side()[0][2], Side::kLower);
}

// y_0 <= 1 and y_1 <= 1 on two levels, and below them y_0 + y_1 = 2, which both
// meet. The row y_0 - y_1 >= bound of the first level depends on the row of the
// third level and on one of the bounds, so that y_1's bound is replaced; the
// last level wants y_1 = 3.
TEST(Exchange, DependsOnRowsOfALowerLevel) {
  const std::vector<LevelCapacity> capacity{{0, 3}, {1, 0}, {2, 0}};
  const auto at = [&](double lower) {
    Hierarchy hierarchy(2, capacity);
    InequalityBlock bounds = hierarchy.AddInequalities(0, 3);
    bounds.C << 1, 0, 0, 1, 1, -1;
    bounds.lower << -kInfinity, -kInfinity, lower;
    bounds.upper << 3, 1, kInfinity;
    EqualityBlock sum = hierarchy.AddEqualities(1, 1);
    sum.B << 1, 1;
    sum.b << -2;
    EqualityBlock task = hierarchy.AddEqualities(2, 2);
    task.B << 1, 1, 1, -1;
    task.b << -4, 2;
    return hierarchy;
  };
  PathBetween search(2, capacity);
  search.Begin(at(-1));
  ASSERT_EQ(search.side()[0][1], Side::kUpper);
  ASSERT_NEAR((search.y() - Eigen::Vector2d(1, 1)).norm(), 0, kTolerance);
  const Hierarchy end = at(1);
  EXPECT_FALSE(search.Follow(end, 0));
  EXPECT_EQ(search.side()[0][1], Side::kNone);
  EXPECT_EQ(search.side()[0][2], Side::kLower);
  EXPECT_TRUE(search.Follow(end, 0));
  EXPECT_NEAR((search.y() - Eigen::Vector2d(1.5, 0.5)).norm(), 0, kTolerance);
}

// y_1 <= 1, and part y_0 + y_1 <= bound, which goes from 2 to 0.9999. Then y_1
// wants 3, and y_0 wants 0. The second row is nearly the same as the first one,
// but independent of it. So both stay active, and y_0 misses its target.
TEST(Exchange, IsNotMadeWithANearlyDependentRow) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}, {2, 0}};
  for (const double part : {2e-3, 9e-4, 1e-5}) {
    SCOPED_TRACE(part);
    const auto at = [&](double bound) {
      Hierarchy hierarchy(2, capacity);
      InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
      bounds.C << 0, 1, part, 1;
      bounds.lower.setConstant(-kInfinity);
      bounds.upper << 1, bound;
      EqualityBlock first = hierarchy.AddEqualities(1, 1);
      first.B << 0, 1;
      first.b << -3;
      EqualityBlock last = hierarchy.AddEqualities(2, 2);
      last.B << 1, 0, 1, 1e-3;  // Not a diagonal level.
      last.b.setZero();
      return hierarchy;
    };
    PathBetween search(2, capacity);
    search.Begin(at(2));
    const Hierarchy end = at(0.9999);
    ASSERT_TRUE(search.Follow(end));
    // The rows amplify rounding by 1 / part.
    EXPECT_NEAR(search.y()[0], (0.9999 - 1) / part, kTolerance / part);
    EXPECT_NEAR(search.y()[1], 1, kTolerance);
  }
}

// The first level has two rows, y_0 + y_1 / 2 = 3 and y_0 + y_1 / 2 = 0, so
// that its optimum, 1.5, leaves residuals. The factors of its two rows are not
// unique, so that no row is replaced. The path finds the optimum all the same.
TEST(Exchange, IsNotMadeWithADeficientLevel) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {0, 2}, {2, 0}};
  const auto at = [&](double upper) {
    Hierarchy hierarchy(2, capacity);
    EqualityBlock contradiction = hierarchy.AddEqualities(0, 2);
    contradiction.B << 1, 0.5, 1, 0.5;
    contradiction.b << -3, 0;
    InequalityBlock bounds = hierarchy.AddInequalities(1, 2);
    bounds.C << 0, 1, 1, 2;
    bounds.lower.setConstant(-kInfinity);
    bounds.upper << 1, upper;
    EqualityBlock task = hierarchy.AddEqualities(2, 2);
    task.B << 1, 1, 1, -1;
    task.b << -7, -1;
    return hierarchy;
  };
  PathBetween search(2, capacity);
  search.Begin(at(9));
  ASSERT_NEAR((search.y() - Eigen::Vector2d(1, 1)).norm(), 0, kTolerance);
  const Hierarchy end = at(2);
  EXPECT_FALSE(search.Follow(end, 0));
  EXPECT_EQ(search.side()[1][0], Side::kUpper);
  EXPECT_EQ(search.side()[1][1], Side::kUpper);
  EXPECT_TRUE(search.Follow(end));
  EXPECT_EQ(search.side()[1][0], Side::kNone);
  EXPECT_NEAR((search.y() - Eigen::Vector2d(4.0 / 3, 1.0 / 3)).norm(), 0,
              10 * kTolerance);
}

}  // namespace
}  // namespace poise
