// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hqp/cascade.h"
#include "hqp/certificate.h"
#include "tests/util/count_malloc.h"
#include "tests/util/random_hierarchy.h"

namespace poise {
namespace {

// What the cost of a level is added up from at y, squared.
double CostSize(const Hierarchy& hierarchy, int level,
                const Solution& solution) {
  const double norm = solution.y.norm();
  double size = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    size += hierarchy.weight(level)[i] *
            std::pow(hierarchy.B(level).row(i).norm() * norm +
                         std::abs(hierarchy.b(level)[i]),
                     2);
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    size += std::pow(hierarchy.C(level).row(i).norm() * norm +
                         solution.levels[level].slack[i],
                     2);
  }
  return size;
}

TEST(Solver, AgreesWithTheCascade) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    Cascade cascade(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    Certifier certifier(n, drawn.capacity);
    Solution reference(n, drawn.capacity), solution(n, drawn.capacity);
    ASSERT_EQ(cascade.Solve(hierarchy, &reference), Status::kOptimal);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_LE(certifier.Certify(hierarchy, reference).worst(), 1e-9);
    EXPECT_LE(certifier.Certify(hierarchy, solution).worst(), 1e-9);
    for (int level = 0; level < hierarchy.num_levels(); ++level) {
      EXPECT_NEAR(solution.levels[level].cost, reference.levels[level].cost,
                  1e-9 * CostSize(hierarchy, level, reference));
      EXPECT_EQ(solution.levels[level].nullity,
                reference.levels[level].nullity);
    }
    CountMalloc count;
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_EQ(count.allocations(), 0);
    EXPECT_LE(solution.iterations, 2);
  }
}

}  // namespace
}  // namespace poise
