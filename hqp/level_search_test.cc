// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/level_search.h"

#include <gtest/gtest.h>

#include "hqp/active_problem.h"
#include "hqp/budget.h"
#include "hqp/cascade.h"
#include "hqp/hierarchy.h"
#include "hqp/solution.h"
#include "tests/util/random_hierarchy.h"

namespace poise {
namespace {

std::vector<std::vector<Side>> NoSides(
    const std::vector<LevelCapacity>& capacity) {
  std::vector<std::vector<Side>> side;
  for (const LevelCapacity& level : capacity) {
    side.emplace_back(level.inequalities, Side::kNone);
  }
  return side;
}

class LevelSearchTest : public testing::TestWithParam<int> {
 protected:
  LevelSearchTest() {
    Cascade cascade(n_, drawn_.capacity);
    EXPECT_EQ(cascade.Solve(hierarchy_, &reference_), Status::kOptimal);
  }
  static HierarchyCase Draw() {
    RandomHierarchyOptions options;
    options.scaled = 0;
    return MakeRandomHierarchy(GetParam(), options);
  }
  // As many levels as the budget pays for, and what they cost.
  int Search(int max_iterations) {
    ActiveProblem problem(n_, drawn_.capacity);
    EXPECT_EQ(problem.Read(hierarchy_, &found_.failed_level), Status::kOptimal);
    std::vector<std::vector<Side>> side = NoSides(drawn_.capacity);
    Budget budget(max_iterations, 0, &no_clock_);
    const int levels = search_.Search(hierarchy_, &budget, &problem, &side);
    iterations_ = budget.iterations();
    found_.y = Eigen::VectorXd::Map(search_.y().data(), n_);
    for (int level = 0; level < num_levels_; ++level) {
      EvaluateLevel(hierarchy_, level, &found_);
    }
    return levels;
  }
  double Tolerance(int level) const {
    return 1e-9 * CostSize(hierarchy_, level, reference_);  // As of Solver.
  }

  const HierarchyCase drawn_ = Draw();
  const Hierarchy& hierarchy_ = drawn_.hierarchy;
  const int n_ = hierarchy_.num_variables();
  const int num_levels_ = hierarchy_.num_levels();
  const std::function<double()> no_clock_;
  Solution reference_{n_, drawn_.capacity}, found_{n_, drawn_.capacity};
  LevelSearch search_{n_, drawn_.capacity};
  int iterations_ = 0;
};

TEST_P(LevelSearchTest, AgreesWithTheCascade) {
  ASSERT_EQ(Search(10000), num_levels_ + 1);
  for (int level = 0; level < num_levels_; ++level) {
    EXPECT_NEAR(found_.levels[level].cost, reference_.levels[level].cost,
                Tolerance(level))
        << level;
  }
  // The smallest of all optima, which is one point.
  EXPECT_LE((found_.y - reference_.y).norm(), 1e-6 * (1 + reference_.y.norm()));
}

// What the budget leaves unsolved is at the bottom; the levels above hold.
TEST_P(LevelSearchTest, KeepsWhatItHasSolvedWhenItsBudgetEnds) {
  ASSERT_EQ(Search(10000), num_levels_ + 1);
  const int needed = iterations_;
  for (int budget = 0; budget < needed; ++budget) {
    const int levels = Search(budget);
    ASSERT_LE(levels, num_levels_);
    EXPECT_EQ(iterations_, budget);
    for (int level = 0; level < levels; ++level) {
      EXPECT_NEAR(found_.levels[level].cost, reference_.levels[level].cost,
                  Tolerance(level))
          << level << " of " << levels;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LevelSearchTest, testing::Range(0, 200));

}  // namespace
}  // namespace poise
