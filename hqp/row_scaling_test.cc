// Rows of one level whose residuals have very different sizes. Small residuals
// are not rounding. The expected answers were derived by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/hierarchy_by_hand.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Expects the certified answer y from a solver that has solved `before`, and
// from the same solver after Forget().
void ExpectSolution(const HierarchyByHand& before,
                    const HierarchyByHand& problem,
                    const std::vector<double>& y) {
  const int n = problem.hierarchy.num_variables();
  std::vector<LevelCapacity> capacity = problem.capacity;
  capacity.resize(std::max(capacity.size(), before.capacity.size()));
  for (size_t level = 0; level < before.capacity.size(); ++level) {
    const LevelCapacity& rows = before.capacity[level];
    LevelCapacity& to = capacity[level];
    to.equalities = std::max(to.equalities, rows.equalities);
    to.inequalities = std::max(to.inequalities, rows.inequalities);
  }
  Solver solver(n, capacity);
  Solution solution(n, capacity);
  ASSERT_EQ(solver.Solve(before.hierarchy, &solution), Status::kOptimal);
  for (const bool is_new : {false, true}) {
    SCOPED_TRACE(is_new ? "cold" : "after another hierarchy");
    if (is_new) solver.Forget();
    ASSERT_EQ(solver.Solve(problem.hierarchy, &solution), Status::kOptimal);
    EXPECT_LE(
        Certifier(n, capacity).Certify(problem.hierarchy, solution).worst(),
        Certifier::kCertified);
    for (int j = 0; j < n; ++j) {
      // Each entry is the result of a few operations. Where terms cancel, they
      // are near 1.
      const double size = y[j] != 0 ? std::abs(y[j]) : 1;
      EXPECT_NEAR(solution.y[j], y[j], Rounding(size, 4)) << j;
    }
  }
}

void ExpectSolution(const HierarchyByHand& problem,
                    const std::vector<double>& y) {
  ExpectSolution(problem, problem, y);
}

// An unloaded foot: the gradient of the momentum level along the row of the
// foot is tiny, but not zero. The gradient of the posture level has the
// opposite sign.
TEST(RowScaling, KeepsARowWithASmallMultiplier) {
  constexpr double kHardly = 3e-11;
  // The gradient of the third row is 5e-12 of the residual of the two rows of
  // y2.
  const HierarchyByHand problem(3, {{0, {0, 1, 0}, -INFINITY, 0},
                                    {1, {1, 0, 0}, 0, 0},
                                    {1, {1, kHardly, 0}, 1, 1},
                                    {1, {0, 0, 1}, 0, 0},
                                    {1, {0, 0, 1}, 6, 6},
                                    {2, {0, 1, 0}, -1, -1}});
  ExpectSolution(problem, {0.5, 0, 3});
}

// The gradient of the small-norm rows is 1e-12 of that of the large-norm rows.
TEST(RowScaling, MeetsASmallRowBesideALargeConflict) {
  ExpectSolution(HierarchyByHand(2, {{0, {-1, 1}, -INFINITY, -1},
                                     {1, {0, 1}, -INFINITY, -1},
                                     {2, {0.001, 0}, 0.003, 0.003},
                                     {2, {0, 1000}, 3000, 3000}}),
                 {3, -1});
  ExpectSolution(HierarchyByHand(2, {{0, {1, 0}, -INFINITY, 0},
                                     {0, {1, 1}, -INFINITY, -1},
                                     {1, {1000, 0}, 5000, 5000},
                                     {1, {0, 0.001}, -0.003, -0.003}}),
                 {0, -3});
}

// The first row is added and removed again. The rotations of this removal leave
// rounding of the large target in the other row.
TEST(RowScaling, IgnoresRoundingOfALargeRow) {
  for (int k = 1; k <= 20; ++k) {
    SCOPED_TRACE(k);
    ExpectSolution(HierarchyByHand(2, {{0, {-1, 1. * k}, -INFINITY, -1},
                                       {1, {0, 1}, -INFINITY, -1},
                                       {2, {0.001, 0}, 0.003, 0.003},
                                       {2, {0, 1000}, 3000, 3000}}),
                   {3, -1});
  }
}

// The last level moves y1 to 0. The gradient of y1 is 1e-12 of that of y0. The
// first row was active in the previous solve.
TEST(RowScaling, RemovesARowThatWasActiveBefore) {
  ExpectSolution(HierarchyByHand(2, {{0, {1, 1}, -INFINITY, -1},
                                     {1, {1, 0}, -INFINITY, 0}}),
                 HierarchyByHand(2, {{0, {1, 1}, -INFINITY, 0},
                                     {1, {1, 0}, -1, -1},
                                     {1, {1, 0}, -INFINITY, 5},
                                     {2, {1000, 0}, 0, 0},
                                     {2, {0, 0.001}, 0, 0}}),
                 {-1, 0});
}

// Two rows of one variable: 1000 y = 0 and 0.001 y = -1. The second row has
// 1e-12 of the weight of the first, and still counts: y is -1e-9 / (1 + 1e-12),
// in either order.
TEST(RowScaling, CountsASmallWeightInAMean) {
  const RowByHand light{0, {0.001}, -1, -1}, heavy{0, {1000}, 0, 0};
  const double mean = -0.001 / (1e6 + 1e-6);
  ExpectSolution(HierarchyByHand(1, {light, heavy}), {mean});
  ExpectSolution(HierarchyByHand(1, {heavy, light}), {mean});
}

// The second level minimises (1000 y0)^2 + (0.01 y1)^2 where y0 + y1 = -2, so
// y0 is 1e-10 y1.
TEST(RowScaling, FindsASmallResidualToAllDigits) {
  const double y1 = -2 / (1 + 1e-10);
  ExpectSolution(HierarchyByHand(2, {{0, {1, 1}, -INFINITY, -2},
                                     {1, {1000, 0}, 0, 0},
                                     {1, {0, 0.01}, 0, 0},
                                     {1, {0, 1}, -INFINITY, -1}}),
                 {1e-10 * y1, y1});
}

// Other solvers use bounds of 1e30 for infinity. At such a y the other rows
// would lose all digits. In the previous solve, row 1 of level 0 was active.
// Here this row has bounds of 1e30.
TEST(RowScaling, TreatsABoundOf1e30AsInfinite) {
  constexpr double kNone = 1e30;
  ExpectSolution(HierarchyByHand(3, {{0, {0, 0, -2}, -INFINITY, 0},
                                     {0, {1, 0, 1}, -INFINITY, -2}}),
                 HierarchyByHand(3, {{0, {0, 0, -2}, -INFINITY, 0},
                                     {0, {1, 0, 0}, -kNone, kNone},
                                     {0, {0, 1, 0}, -kNone, kNone},
                                     {0, {0, 0, 1}, -kNone, kNone},
                                     {1, {2, 1, -1}, -INFINITY, 2},
                                     {1, {0, -1, -2}, -INFINITY, 0},
                                     {1, {-2, 0, -1}, -INFINITY, -3}}),
                 {1.2, 0, 0.6});
}

}  // namespace
}  // namespace poise
