// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests levels whose rows have residuals of very different size: the small
// residuals are not rounding. The answers were computed by hand.
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

// Expects the certified solution from a solver that has solved `before`, and from a
// new one.
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
    SCOPED_TRACE(is_new ? "from nothing" : "after another");
    if (is_new) solver.Forget();
    ASSERT_EQ(solver.Solve(problem.hierarchy, &solution), Status::kOptimal);
    EXPECT_LE(
        Certifier(n, capacity).Certify(problem.hierarchy, solution).worst(),
        Certifier::kCertified);
    for (int j = 0; j < n; ++j) {
      // Each entry takes a few operations; terms that cancel have size 1.
      const double size = y[j] != 0 ? std::abs(y[j]) : 1;
      EXPECT_NEAR(solution.y[j], y[j], Rounding(size, 4)) << j;
    }
  }
}

void ExpectSolution(const HierarchyByHand& problem,
                    const std::vector<double>& y) {
  ExpectSolution(problem, problem, y);
}

// A foot without load: the gradient of momentum along its row is tiny, but not
// zero, and that of posture is opposite.
TEST(RowScaling, KeepsARowWithASmallMultiplier) {
  constexpr double kHardly = 3e-11;
  // The gradient of the third is 5e-12 of the residual of the last two.
  const HierarchyByHand problem(3, {{0, {0, 1, 0}, -INFINITY, 0},
                                    {1, {1, 0, 0}, 0, 0},
                                    {1, {1, kHardly, 0}, 1, 1},
                                    {1, {0, 0, 1}, 0, 0},
                                    {1, {0, 0, 1}, 6, 6},
                                    {2, {0, 1, 0}, -1, -1}});
  ExpectSolution(problem, {0.5, 0, 3});
}

// The gradient of the small rows is 1e-12 of that of the large ones.
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

// The first row is added and removed again. The rotations of the removal leave
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

// The last level moves y1 to 0, with a gradient of 1e-12 of that of y0. In the
// solve before, the first row was active.
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

// Two targets of one variable, 0 and 1: with the weight 1e-12 of the latter, y
// is 1e-12 / (1 + 1e-12), in either order.
TEST(RowScaling, CountsASmallWeightInAMean) {
  const RowByHand light{0, {0.001}, -1, -1}, heavy{0, {1000}, 0, 0};
  const double mean = -0.001 / (1e6 + 1e-6);
  ExpectSolution(HierarchyByHand(1, {light, heavy}), {mean});
  ExpectSolution(HierarchyByHand(1, {heavy, light}), {mean});
}

// The second level, (1000 y0)^2 + (0.01 y1)^2 where y0 + y1 = -2, moves y0 by
// 1e-10 of y1.
TEST(RowScaling, FindsASmallResidualToAllDigits) {
  const double y1 = -2 / (1 + 1e-10);
  ExpectSolution(HierarchyByHand(2, {{0, {1, 1}, -INFINITY, -2},
                                     {1, {1000, 0}, 0, 0},
                                     {1, {0, 0.01}, 0, 0},
                                     {1, {0, 1}, -INFINITY, -1}}),
                 {1e-10 * y1, y1});
}

// Bounds of 1e30 mean none in other solvers. At such a y the other rows would
// lose all digits. In the solve before, a row in the place of the first was
// active.
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
