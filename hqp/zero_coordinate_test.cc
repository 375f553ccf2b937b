// Rows meet at a point with zero coordinates. Rounding of such a coordinate
// would violate a row y_j >= 0 by 100 % of its terms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/hierarchy_by_hand.h"

namespace poise {
namespace {

constexpr double kCertified = Certifier::kCertified;

Solution Solve(const HierarchyByHand& problem) {
  const int n = problem.hierarchy.num_variables();
  Solver solver(n, problem.capacity);
  Solution solution(n, problem.capacity);
  EXPECT_EQ(solver.Solve(problem.hierarchy, &solution), Status::kOptimal);
  EXPECT_LE(Certifier(n, problem.capacity)
                .Certify(problem.hierarchy, solution)
                .worst(),
            kCertified);
  return solution;
}

// y0 = -6e-17 instead of 0 would violate the row of the second level.
TEST(ZeroCoordinate, IsZeroWhereTwoRowsMeet) {
  const HierarchyByHand problem(2, {{0, {4, 5}, -INFINITY, -5},
                                    {0, {-2, 5}, -INFINITY, -5},
                                    {1, {1, 0}, 0, INFINITY}});
  const Solution solution = Solve(problem);
  EXPECT_EQ(solution.y[0], 0);
  EXPECT_NEAR(solution.y[1], -1, 1e-15);  // Five roundings of 1.
}

// y = (0, 3) meets all rows. Rounding would violate only the rows of y0 alone.
TEST(ZeroCoordinate, IsZeroWhereFiveRowsMeet) {
  const HierarchyByHand problem(2, {{0, {1, 2}, -INFINITY, 6},
                                    {0, {-1, 0}, 0, INFINITY},
                                    {0, {3, -1}, -3, INFINITY},
                                    {1, {-4, 1}, 3, INFINITY},
                                    {2, {3, 3}, 9, INFINITY},
                                    {2, {-5, 0}, 0, INFINITY}});
  const Solution solution = Solve(problem);
  EXPECT_EQ(solution.y[0], 0);
  EXPECT_NEAR(solution.y[1], 3, 3e-15);
}

// y = (0, -2, 0, 0) has three zero coordinates, and rows couple them.
TEST(ZeroCoordinate, IsZeroInRowsThatShareVariables) {
  const HierarchyByHand problem(4, {{0, {0, -4, -1, 0}, 8, 8},
                                    {0, {-3, 1, 0, 0}, -2, -2},
                                    {1, {-3, 0, 0, 1}, 0, 0},
                                    {1, {0, 0, 1, 0}, -INFINITY, 0},
                                    {2, {0, 0, 1, -2}, 0, 0}});
  const Solution solution = Solve(problem);
  for (const int j : {0, 2, 3}) EXPECT_EQ(solution.y[j], 0) << j;
  EXPECT_NEAR(solution.y[1], -2, 2e-15);
}

// The rows of level 0 fix y. After refinement, y also meets the target of level
// 1 exactly.
TEST(ZeroCoordinate, HasZeroMultipliersIfRefinementMeetsTheLevel) {
  const HierarchyByHand problem(2, {{0, {2, 0}, 2, 2},
                                    {0, {0, -3}, 0, 0},
                                    {0, {-4, 5}, -4, -4},
                                    {1, {0, -1}, 0, 0}});
  const Solution solution = Solve(problem);
  EXPECT_EQ(solution.y[1], 0);
  EXPECT_NEAR(solution.y[0], 1, 1e-15);
  EXPECT_TRUE(solution.levels[1].multipliers[0].equality.isZero(0));
}

// Random rows of small integers through a point of small integers. Each row has
// a bound at the point, on either side, so the point meets all rows.
TEST(ZeroCoordinate, IsFoundInRandomHierarchies) {
  for (int seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto draw = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    const int n = draw(2, 6), levels = draw(2, 3);
    std::vector<int> point(n);
    for (int& entry : point) entry = draw(0, 2) < 2 ? 0 : draw(-3, 3);
    std::vector<RowByHand> rows;
    for (int level = 0; level < levels; ++level) {
      for (int i = draw(1, n + 2); i > 0; --i) {
        RowByHand row{level, {}, -INFINITY, INFINITY};
        double value = 0;
        for (int j = 0; j < n; ++j) {
          row.row.push_back(draw(-5, 5));
          value += row.row[j] * point[j];
        }
        (draw(0, 1) == 0 ? row.lower : row.upper) = value;
        rows.push_back(row);
      }
    }
    const HierarchyByHand problem(n, rows);
    const Solution solution = Solve(problem);
    for (int level = 0; level < levels; ++level) {
      // At most 8 rows. Each has 6 terms of at most 5 * 3, and is met to 1e-13
      // of their sum.
      EXPECT_LE(solution.levels[level].cost, 8 * std::pow(90e-13, 2));
    }
  }
}

}  // namespace
}  // namespace poise
