// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/shrink_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/hqp/solver.h"
#include "poise/tests/util/compare_solvers.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

int NumRows(const Hierarchy& hierarchy) {
  int rows = 0;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    rows += hierarchy.num_equalities(k) + hierarchy.num_inequalities(k);
  }
  return rows;
}

// Returns whether the solver needs more than one factorisation. One bound that
// must become active is enough for this.
bool NeedsASearch(const HierarchyCase& drawn) {
  const int n = drawn.hierarchy.num_variables();
  Solution solution(n, drawn.capacity);
  return Solver(n, drawn.capacity).Solve(drawn.hierarchy, &solution) !=
             Status::kOptimal ||
         solution.iterations > 1;
}

TEST(ShrinkHierarchy, LeavesOneBlockingBound) {
  int failures = 0;
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    if (!NeedsASearch(drawn)) continue;
    ++failures;
    const HierarchyCase shrunk = ShrinkHierarchy(drawn, NeedsASearch);
    const Hierarchy& hierarchy = shrunk.hierarchy;
    EXPECT_TRUE(NeedsASearch(shrunk));
    EXPECT_EQ(hierarchy.num_variables(), 1);
    int inequalities = 0;
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      inequalities += hierarchy.num_inequalities(k);
    }
    EXPECT_EQ(inequalities, 1);
    EXPECT_LE(NumRows(hierarchy), 2);  // At most one row violates the bound.
  }
  EXPECT_GT(failures, 10);
}

// The case fails only with a certain weight, level and fraction, so shrinking
// keeps these.
TEST(ShrinkHierarchy, KeepsWhatTheFailureNeeds) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {2, 0}, {1, 0}};
  HierarchyCase drawn{capacity, Hierarchy(3, capacity)};
  drawn.hierarchy.AddEqualities(0, 1).B << 1, 2, 3;
  drawn.hierarchy.AddInequalities(0, 1).C << 1, 0, 0;
  EqualityBlock middle = drawn.hierarchy.AddEqualities(1, 2);
  middle.B << 4.25, 5.5, 6.75, 7, 8, 9;
  middle.b << 0.5, 1.7;
  middle.weight << 2, 3;
  drawn.hierarchy.AddEqualities(2, 1).B << 1, 1, 1;
  const HierarchyCase shrunk =
      ShrinkHierarchy(drawn, [](const HierarchyCase& each) {
        const Hierarchy& hierarchy = each.hierarchy;
        if (hierarchy.num_levels() < 2) return false;
        for (int i = 0; i < hierarchy.num_equalities(1); ++i) {
          if (hierarchy.weight(1)[i] == 3 && hierarchy.b(1)[i] > 1.5 &&
              hierarchy.B(1).row(i).sum() > 10.5) {
            return true;
          }
        }
        return false;
      });
  const Hierarchy& hierarchy = shrunk.hierarchy;
  ASSERT_EQ(hierarchy.num_levels(), 2);
  EXPECT_EQ(hierarchy.num_equalities(0), 0);
  EXPECT_EQ(hierarchy.num_inequalities(0), 0);
  ASSERT_EQ(hierarchy.num_equalities(1), 1);
  EXPECT_EQ(hierarchy.b(1)[0], 2);
  EXPECT_EQ(hierarchy.weight(1)[0], 3);
  EXPECT_EQ(hierarchy.B(1), Eigen::RowVector2d(7, 8));
}

// Smallest upper bound of all rows.
double SmallestBound(const HierarchyCase& tick) {
  double smallest = INFINITY;
  for (int level = 0; level < tick.hierarchy.num_levels(); ++level) {
    const auto upper = tick.hierarchy.upper(level);
    if (upper.size() > 0) smallest = std::min(smallest, upper.minCoeff());
  }
  return smallest;
}

// The failure needs an earlier tick with a smaller bound. One such tick is
// enough, and few rows in each.
TEST(ShrinkTicks, KeepsTheTickThatTheFailureNeeds) {
  int failures = 0;
  const auto fails = [](const std::vector<HierarchyCase>& ticks) {
    const double last = SmallestBound(ticks.back());
    return std::any_of(ticks.begin(), ticks.end() - 1, [&](const auto& tick) {
      return SmallestBound(tick) < last;
    });
  };
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<HierarchyCase> ticks;
    HierarchyCase drawn = WithRoomToChange(MakeRandomHierarchy(seed));
    for (int tick = 0; tick < 4; ++tick) {
      if (tick > 0) ChangeHierarchy(100 * seed + tick, &drawn);
      ticks.push_back(drawn);
    }
    if (!fails(ticks)) continue;
    ++failures;
    const std::vector<HierarchyCase> shrunk = ShrinkTicks(ticks, fails);
    EXPECT_TRUE(fails(shrunk));
    ASSERT_EQ(shrunk.size(), 2u);
    for (const HierarchyCase& tick : shrunk) {
      EXPECT_EQ(tick.hierarchy.num_variables(), 1);
      EXPECT_LE(NumRows(tick.hierarchy), 2);
    }
  }
  EXPECT_GT(failures, 5);
}

TEST(Disagreement, FindsRoundingErrorsAtZeroTolerance) {
  int found = 0;
  for (int seed = 0; seed < 50; ++seed) {
    RandomHierarchyOptions options;
    options.scaled = 0;
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    EXPECT_EQ(Disagreement(drawn), "") << seed;
    found += !Disagreement(drawn, 0).empty();
  }
  EXPECT_GT(found, 25);
}

// For y0 + y1 = 2, or >= 2, the optimum of minimum norm is (1, 1). A point 1e-8
// away has a certificate above 1e-9. (2, 0) is also optimal for that level, and
// (3, 3) is for the inequality, but neither has minimum norm.
TEST(CertifyShortest, RejectsYThatDoesNotHaveMinimumNorm) {
  for (const bool is_equality : {false, true}) {
    const std::vector<LevelCapacity> capacity{{1, 1}};
    HierarchyCase drawn{capacity, Hierarchy(2, capacity)};
    if (is_equality) {
      EqualityBlock sum = drawn.hierarchy.AddEqualities(0, 1);
      sum.B << 1, 1;
      sum.b << -2;
    } else {
      InequalityBlock sum = drawn.hierarchy.AddInequalities(0, 1);
      sum.C << 1, 1;
      sum.lower << 2;
    }
    Solution solution(2, capacity);
    solution.y << 1, 1;
    EXPECT_LE(CertifyShortest(drawn, solution).worst(), 1e-15);
    for (const Eigen::Vector2d& y :
         {Eigen::Vector2d(1 + 1e-8, 1 - 1e-8), Eigen::Vector2d(2, 0),
          Eigen::Vector2d(3, 3)}) {
      solution.y = y;
      EXPECT_GT(CertifyShortest(drawn, solution).worst(), 1e-9) << y;
    }
  }
}

// Two rows 2 y = 0 are above 4 y >= 8 and 3 y = 3. With 1e20 and -1e20 added to
// their multipliers, the certificate is as good as before. A level that is
// satisfied, or has zero weight, has zero gradient: any multiplier is then
// infinitely large in comparison.
TEST(LargestMultiplier, DetectsMultipliersThatHideResiduals) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {0, 1}, {1, 0}};
  HierarchyCase drawn{capacity, Hierarchy(1, capacity)};
  drawn.hierarchy.AddEqualities(0, 2).B << 2, 2;
  InequalityBlock bound = drawn.hierarchy.AddInequalities(1, 1);
  bound.C << 4;
  bound.lower << 8;
  EqualityBlock wish = drawn.hierarchy.AddEqualities(2, 1);
  wish.B << 3;
  wish.b << -3;
  Solution solution(1, capacity);
  ASSERT_EQ(Solver(1, capacity).Solve(drawn.hierarchy, &solution),
            Status::kOptimal);
  EXPECT_GE(LargestMultiplier(drawn.hierarchy, solution), 0.5 - 1e-6);
  EXPECT_LE(LargestMultiplier(drawn.hierarchy, solution), 1 + 1e-6);
  const Solution honest = solution;
  for (int level = 1; level < 3; ++level) {
    Certifier certifier(1, capacity);
    solution = honest;
    solution.levels[level].multipliers[0].equality +=
        Eigen::Vector2d(1e20, -1e20);
    EXPECT_LE(certifier.Certify(drawn.hierarchy, solution).worst(), 1e-9);
    EXPECT_GT(LargestMultiplier(drawn.hierarchy, solution), 1e18);
  }
  // The multiplier 32 on a row 2 is compared with the slack 8 on a row 4.
  solution = honest;
  solution.levels[1].multipliers[0].equality << 32, 0;
  EXPECT_NEAR(LargestMultiplier(drawn.hierarchy, solution), 2, 1e-6);
  wish.b << 0;
  solution.levels[2].equality_residual << 0;
  solution.levels[2].multipliers[1].inequality << 1e-3;
  EXPECT_EQ(LargestMultiplier(drawn.hierarchy, solution), INFINITY);
  wish.weight << 0;
  EXPECT_EQ(LargestMultiplier(drawn.hierarchy, solution), INFINITY);
}

// A warm solver is compared like a new one, and in addition to it.
TEST(Disagreement, ComparesAWarmSolverAsWell) {
  HierarchyCase drawn = WithRoomToChange(MakeRandomHierarchy(7));
  Solver living(drawn.hierarchy.num_variables(), drawn.capacity);
  EXPECT_EQ(Disagreement(drawn, 1e-9, &living), "");
  // Without an iteration it can only answer with its last y, which is no
  // optimum of another hierarchy.
  ChangeHierarchy(1, &drawn);
  living.max_iterations = 0;
  EXPECT_NE(Disagreement(drawn, 1e-9, &living).find("the warm solver found no"),
            std::string::npos);
  EXPECT_EQ(Disagreement(drawn), "");
}

// With tolerance 0 the text shows rounding errors, in which a warm solver and a
// new one differ.
TEST(DisagreementAfter, SolvesEarlierTicksWithOneSolver) {
  HierarchyCase drawn = WithRoomToChange(MakeRandomHierarchy(7));
  std::vector<HierarchyCase> ticks{drawn};
  EXPECT_EQ(DisagreementAfter(ticks, 0), Disagreement(drawn, 0));
  Solver living(drawn.hierarchy.num_variables(), drawn.capacity);
  for (int tick = 1; tick < 4; ++tick) {
    Solution solution(drawn.hierarchy.num_variables(), drawn.capacity);
    (void)living.Solve(drawn.hierarchy, &solution);
    ChangeHierarchy(tick, &drawn);
    ticks.push_back(drawn);
  }
  EXPECT_EQ(DisagreementAfter(ticks), "");
  const std::string all = DisagreementAfter(ticks, 0);
  EXPECT_NE(all.find("the warm solver"), std::string::npos) << all;
  EXPECT_EQ(all, Disagreement(drawn, 0, &living));
}

}  // namespace
}  // namespace poise
