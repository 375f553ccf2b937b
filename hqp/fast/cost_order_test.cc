// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/cost_order.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

std::vector<double> ToVector(const Eigen::VectorXd& y) {
  return {y.data(), y.data() + y.size()};
}

// Returns all rows of the first `levels` levels.
Eigen::MatrixXd RowsAbove(const Hierarchy& hierarchy, int levels) {
  Eigen::MatrixXd rows(0, hierarchy.num_variables());
  const auto append = [&](const Eigen::MatrixXd& block) {
    rows.conservativeResize(rows.rows() + block.rows(), Eigen::NoChange);
    rows.bottomRows(block.rows()) = block;
  };
  for (int level = 0; level < levels; ++level) {
    append(hierarchy.B(level));
    append(hierarchy.C(level));
  }
  return rows;
}

// Returns twice the cost of a level in long double. The slack is the distance
// of C y from its projection on the bounds.
long double PreciseCost(const Hierarchy& hierarchy, int level,
                        const Eigen::VectorXd& y) {
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const auto precise = [](const auto& matrix) {
    return matrix.template cast<long double>().eval();
  };
  const Vector residual =
      precise(hierarchy.B(level)) * precise(y) + precise(hierarchy.b(level));
  const Vector value = precise(hierarchy.C(level)) * precise(y);
  const Vector inside = value.cwiseMax(precise(hierarchy.lower(level)))
                            .cwiseMin(precise(hierarchy.upper(level)));
  return residual.dot(precise(hierarchy.weight(level)).cwiseProduct(residual)) +
         (value - inside).squaredNorm();
}

class CostOrderTest : public testing::Test {
 protected:
  CostOrderTest() {
    EqualityBlock first = hierarchy_.AddEqualities(0, 1);
    first.B << 1, -1;
    weight_ = first.weight.data();
    offset_ = first.b.data();
    InequalityBlock second = hierarchy_.AddInequalities(1, 2);
    second.C << 1, 0, 0, 1;
    second.lower << -1, -1e9;
    second.upper << 2, 1e9;
    EqualityBlock third = hierarchy_.AddEqualities(2, 1);
    third.B << 0, 1;
  }

  bool IsBetter(const std::vector<double>& y,
                const std::vector<double>& other) const {
    EXPECT_FALSE(poise::IsBetter(hierarchy_, y, y));
    return poise::IsBetter(hierarchy_, y, other);
  }

  Hierarchy hierarchy_{2, {{1, 0}, {0, 2}, {1, 0}}};
  double* weight_;
  double* offset_;
};

TEST_F(CostOrderTest, TheFirstLevelThatDiffersDecides) {
  EXPECT_TRUE(IsBetter({9, 9}, {0, 1}));
  EXPECT_FALSE(IsBetter({0, 1}, {9, 9}));
  EXPECT_TRUE(IsBetter({3, 3}, {9, 9}));
  EXPECT_FALSE(IsBetter({9, 9}, {3, 3}));
  EXPECT_TRUE(IsBetter({1, 1}, {2, 2}));
  EXPECT_FALSE(IsBetter({2, 2}, {1, 1}));
}

TEST_F(CostOrderTest, ABoundIsViolatedOnEitherSide) {
  EXPECT_TRUE(IsBetter({-2, -2}, {4, 4}));    // 1 below, 2 above.
  EXPECT_TRUE(IsBetter({3, 3}, {-3, -3}));    // 1 above, 2 below.
  EXPECT_TRUE(IsBetter({-1, -1}, {-2, -2}));  // At the bound, 1 below.
}

// Rounding of 1e8 on a row that is met does not hide a violation of 1 on
// another row.
TEST_F(CostOrderTest, ARowThatIsMetHidesNothing) {
  const double large = 1e8;
  EXPECT_TRUE(IsBetter({3, -large}, {4, -large + 1}));
  EXPECT_FALSE(IsBetter({4, -large + 1}, {3, -large}));
}

TEST_F(CostOrderTest, ARowOfWeightZeroHasNoCost) {
  *weight_ = 0;
  EXPECT_TRUE(IsBetter({0, 1}, {9, 9}));
  EXPECT_FALSE(IsBetter({9, 9}, {0, 1}));
}

// y_0 - y_1 = 4e-7 is rounding of entries of 1e8: the levels below decide. A
// thousand times as much is not rounding.
TEST_F(CostOrderTest, RoundingOfThePointsDecidesNothing) {
  const double large = 1e8;
  EXPECT_TRUE(IsBetter({-large, -large + 4e-7}, {-2 * large, -2 * large}));
  EXPECT_FALSE(IsBetter({-large, -large + 4e-4}, {-2 * large, -2 * large}));
}

// Where a row misses its target by 1, the rounding 4e-7 changes the cost by
// 8e-7 of it.
TEST_F(CostOrderTest, RoundingOfThePointsDecidesNothingBesideAResidual) {
  const double large = 1e8;
  *offset_ = 1;
  EXPECT_TRUE(IsBetter({-large, -large - 4e-7}, {-2 * large, -2 * large}));
  EXPECT_FALSE(IsBetter({-large, -large - 4e-4}, {-2 * large, -2 * large}));
}

// The terms 1000 and -999 leave a residual of 1. Its rounding counts, not that
// of 1999: a change of the cost by 1e-7 decides, though the last level is
// worse.
TEST_F(CostOrderTest, TermsThatCancelDoNotCountAsAResidual) {
  *offset_ = -999;
  EXPECT_TRUE(IsBetter({1000, 5e-8}, {1000, 0}));
  EXPECT_FALSE(IsBetter({1000, 0}, {1000, 5e-8}));
}

// Entries of 2e8 are right to 1e-13 of it, so that their difference is right to
// 4e-5. A residual of 6e-5 is near that: it may be 2e-5, and its cost decides
// nothing.
TEST_F(CostOrderTest, TheWorsePointIsRoundedToo) {
  const double large = 1e8;
  EXPECT_TRUE(IsBetter({-large, -large - 6e-5}, {-2 * large, -2 * large}));
  EXPECT_FALSE(IsBetter({-2 * large, -2 * large}, {-large, -large - 6e-5}));
}

// The rows y_1 = 1 and y_1 = -1 contradict each other. A row of weight 1e6 that
// is met does not hide that they are missed by more.
TEST(CostOrder, ARowOfLargeWeightThatIsMetHidesNothing) {
  Hierarchy hierarchy(2, {{3, 0}, {1, 0}});
  EqualityBlock first = hierarchy.AddEqualities(0, 3);
  first.B << 1, 0, 0, 1, 0, 1;
  first.b << -3, -1, 1;
  first.weight[0] = 1e6;
  EqualityBlock second = hierarchy.AddEqualities(1, 1);
  second.B << 0, 1;
  second.b << -1;
  EXPECT_TRUE(IsBetter(hierarchy, {3, 0}, {3, 9e-3}));
  EXPECT_FALSE(IsBetter(hierarchy, {3, 9e-3}, {3, 0}));
}

// The bounds y_0 >= 1 and y_0 <= -1 are best at y_0 = 0. There, y_0 is
// rounding, and the cost 1 + y_0^2 is the same in double precision but for its
// last digit.
TEST(CostOrder, RoundingAtACompromiseOfBoundsDecidesNothing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Hierarchy hierarchy(2, {{0, 2}, {1, 0}});
  InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
  bounds.C << 1, 0, 1, 0;
  bounds.lower << 1, -kInfinity;
  bounds.upper << kInfinity, -1;
  EqualityBlock second = hierarchy.AddEqualities(1, 1);
  second.B << 0, 1;
  for (int i = 1; i < 2000; ++i) {
    const std::vector<double> better = {i * 3.7e-12, 0};
    const std::vector<double> worse = {i * -2.3e-12, 1e-6};
    EXPECT_TRUE(IsBetter(hierarchy, better, worse)) << i;
    EXPECT_FALSE(IsBetter(hierarchy, worse, better)) << i;
  }
}

// y_0 >= 1e4 is missed by 1e4 or by 1e-9 less. The cost changes by 2e-13 of
// itself, which is rounding of its terms, though C y is 0.
TEST(CostOrder, RoundingOfTheTermsOfASlackDecidesNothing) {
  Hierarchy hierarchy(2, {{0, 1}, {1, 0}});
  InequalityBlock bound = hierarchy.AddInequalities(0, 1);
  bound.C << 1, 0;
  bound.lower << 1e4;
  hierarchy.AddEqualities(1, 1).B << 0, 1;
  EXPECT_TRUE(IsBetter(hierarchy, {0, 0}, {1e-9, 1}));
  EXPECT_FALSE(IsBetter(hierarchy, {0, 0}, {1e-3, 1}));
}

// The points differ in the nullspace of the levels above one that is drawn, so
// that these levels have the same cost but for rounding.
TEST(CostOrder, AgreesWithCostsInLongDouble) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int decided = 0, below = 0;
  for (int seed = 1; seed <= 500; ++seed) {
    HierarchyCase drawn = MakeRandomHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const auto draw = [&](Eigen::Index size) {
      return Eigen::VectorXd::NullaryExpr(size, [&] { return normal(random); });
    };
    const int n = hierarchy.num_variables(), levels = hierarchy.num_levels();
    const int above = std::uniform_int_distribution<>(0, levels - 1)(random);
    Eigen::MatrixXd free = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd rows = RowsAbove(hierarchy, above);
    if (rows.rows() > 0) free = rows.fullPivLu().kernel();
    const Eigen::VectorXd y = draw(n), other = y + free * draw(free.cols());
    for (int level = above; level < levels; ++level) {
      const long double cost = PreciseCost(hierarchy, level, y);
      const long double than = PreciseCost(hierarchy, level, other);
      // Rounding of this order cannot decide, and what lies between is not
      // tested.
      if (std::abs(cost - than) <= 1e-6L * std::max(cost, than)) continue;
      EXPECT_EQ(IsBetter(hierarchy, ToVector(y), ToVector(other)), cost < than)
          << "seed " << seed << ", level " << level;
      EXPECT_EQ(IsBetter(hierarchy, ToVector(other), ToVector(y)), than < cost)
          << "seed " << seed << ", level " << level;
      ++decided;
      if (level > 0) ++below;
      break;
    }
  }
  EXPECT_GT(decided, 300);
  EXPECT_GT(below, 100);
}

TEST(CostOrder, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  const HierarchyCase drawn = MakeRandomHierarchy(1);
  const std::vector<double> y(drawn.hierarchy.num_variables(), 1);
  const std::vector<double> other(drawn.hierarchy.num_variables(), -2);
  CountMalloc count;
  EXPECT_NE(IsBetter(drawn.hierarchy, y, other),
            IsBetter(drawn.hierarchy, other, y));
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
