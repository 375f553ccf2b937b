// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The gap of a certificate, against the exact optimum of small hierarchies, and
// between pairs of answers to large ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/exact/lexicographic_qp.h"
#include "poise/tests/exact/small_hierarchy.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

// How far the costs of an answer are above those of another one, while the
// levels above cost the same. Rounding of y in a level above may buy a lower
// cost below; the gap of that level covers it.
void ExpectWithinGaps(const Hierarchy& hierarchy, const Solution& solution,
                      const std::vector<double>& optimal, Certifier* certifier,
                      int* tight) {
  (void)certifier->Certify(hierarchy, solution);
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const double cost = solution.levels[level].cost;
    // The costs themselves are rounded in their last digits.
    EXPECT_LE(cost - optimal[level], certifier->gap(level) + 1e-14 * cost)
        << "level " << level;
    *tight += certifier->gap(level) <= 1e-6 * std::max(cost, 1.0);
  }
}

TEST(Gap, CoversTheExactOptimum) {
  int tight = 0, levels = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeSmallHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    const ExactOptimum exact = SolveExactly(hierarchy);
    std::vector<double> costs;
    for (const ExactLevel& level : exact.levels) {
      costs.push_back(level.cost.get_d());
    }
    Certifier certifier(n, drawn.capacity);
    Solution solution(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    ExpectWithinGaps(hierarchy, solution, costs, &certifier, &tight);
    levels += hierarchy.num_levels();
  }
  // A bound that is always the whole cost would be of no use.
  EXPECT_GE(tight, levels * 9 / 10);
}

// The gaps of a solver that was stopped. A level is compared if the levels above
// cost what they must.
TEST(Gap, CoversASolverThatWasStopped) {
  int stopped = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const HierarchyCase drawn = MakeSmallHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    const ExactOptimum exact = SolveExactly(hierarchy);
    Certifier certifier(n, drawn.capacity);
    Solution solution(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    for (int limit = 0; limit < 12; ++limit) {
      SCOPED_TRACE(testing::Message() << seed << ", " << limit);
      solver.Forget();
      solver.max_iterations = limit;
      stopped += solver.Solve(hierarchy, &solution) != Status::kOptimal;
      certifier.Truncate(hierarchy, &solution);
      for (int level = 0; level < hierarchy.num_levels(); ++level) {
        const double cost = solution.levels[level].cost;
        const double optimal = exact.levels[level].cost.get_d();
        EXPECT_LE(cost - optimal, certifier.gap(level) + 1e-14 * cost)
            << "level " << level;
        // The data are whole numbers, so that costs of 1e-12 are rounding.
        if (std::abs(cost - optimal) > 1e-12 * (1 + optimal)) break;
      }
    }
  }
  EXPECT_GT(stopped, 200);
}

// Fast and cascade, and the fast solver warm, on hierarchies of control size.
TEST(Gap, CoversTheDifferenceOfTwoSolvers) {
  int tight = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    Solution first(n, drawn.capacity), second(n, drawn.capacity);
    Certifier certifier(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    Cascade cascade(n, drawn.capacity);
    if (solver.Solve(hierarchy, &first) != Status::kOptimal) continue;
    if (cascade.Solve(hierarchy, &second) != Status::kOptimal) continue;
    std::vector<double> costs[2];
    for (int level = 0; level < hierarchy.num_levels(); ++level) {
      costs[0].push_back(first.levels[level].cost);
      costs[1].push_back(second.levels[level].cost);
    }
    ExpectWithinGaps(hierarchy, first, costs[1], &certifier, &tight);
    ExpectWithinGaps(hierarchy, second, costs[0], &certifier, &tight);
    ASSERT_EQ(solver.Solve(hierarchy, &second), Status::kOptimal);
    ExpectWithinGaps(hierarchy, second, costs[1], &certifier, &tight);
  }
  EXPECT_GT(tight, 0);
}

}  // namespace
}  // namespace poise
