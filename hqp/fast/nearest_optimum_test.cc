// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of ParametricSearch::MeetLevelsBeforeLast().
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/path_between.h"

namespace poise {
namespace {

using Sides = ParametricSearch::Sides;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Relative tolerance of y. The condition of rows of normally distributed numbers is
// below 1e4 in these tests, and multiplies rounding by its square.
constexpr double kSameY = 1e-7;

// Level 0 has equalities, level 1 limits, level 2 a task, level 3 chooses. All
// numbers are drawn.
class FirstLevels {
 public:
  explicit FirstLevels(int seed) : numbers_(seed) {
    for (RowMajorMatrix* matrix : {&B_, &C_, &T_}) {
      *matrix = RowMajorMatrix::NullaryExpr(matrix == &C_ ? 16 : 3, kVariables,
                                            [&] { return normal_(numbers_); });
    }
  }
  // The first `open` limits are infinite.
  Hierarchy Draw(int open = 0) {
    Hierarchy hierarchy(kVariables, capacity());
    EqualityBlock first = hierarchy.AddEqualities(0, 3);
    first.B = B_;
    for (double& b : first.b) b = normal_(numbers_);
    InequalityBlock limits = hierarchy.AddInequalities(1, 16);
    limits.C = C_;
    limits.lower.setConstant(-2);
    limits.upper.setConstant(2);
    limits.lower.head(open).setConstant(-kInfinity);
    limits.upper.head(open).setConstant(kInfinity);
    EqualityBlock task = hierarchy.AddEqualities(2, 3);
    task.B = T_;
    for (double& b : task.b) b = 5 * normal_(numbers_);
    hierarchy.AddEqualities(3, kVariables).B.setIdentity();
    return hierarchy;
  }
  static std::vector<LevelCapacity> capacity() {
    return {{3, 0}, {0, 16}, {3, 0}, {kVariables, 0}};
  }
  static constexpr int kVariables = 12;

 private:
  std::mt19937 numbers_;
  std::normal_distribution<double> normal_;
  RowMajorMatrix B_{3, kVariables}, C_{16, kVariables}, T_{3, kVariables};
};

// Violation of the equalities and limits, the largest one.
double Violation(const Hierarchy& hierarchy, const Eigen::VectorXd& y) {
  const Eigen::VectorXd value = hierarchy.C(1) * y;
  return std::max((hierarchy.B(0) * y + hierarchy.b(0)).cwiseAbs().maxCoeff(),
                  (value - hierarchy.upper(1))
                      .cwiseMax(hierarchy.lower(1) - value)
                      .maxCoeff());
}

// Returns the point closest to `from` that meets levels 0 and 1, found in another way:
// by the cascade, with `from` as the target of the last level.
Eigen::VectorXd FindNearest(const Hierarchy& hierarchy,
                            const Eigen::VectorXd& from) {
  const int n = FirstLevels::kVariables;
  const std::vector<LevelCapacity> capacity{{3, 0}, {0, 16}, {n, 0}};
  Hierarchy nearest(n, capacity);
  EqualityBlock first = nearest.AddEqualities(0, 3);
  first.B = hierarchy.B(0);
  first.b = hierarchy.b(0);
  InequalityBlock limits = nearest.AddInequalities(1, 16);
  limits.C = hierarchy.C(1);
  limits.lower = hierarchy.lower(1);
  limits.upper = hierarchy.upper(1);
  EqualityBlock last = nearest.AddEqualities(2, n);
  last.B.setIdentity();
  last.b = -from;
  Cascade cascade(n, capacity);
  Solution solution(n, capacity);
  EXPECT_EQ(cascade.Solve(nearest, &solution), Status::kOptimal);
  return solution.y;
}

// The point is the closest one, unless the optimum of the working set violates no
// bound: then no path is needed, and it may be farther away.
TEST(NearestOptimum, MeetsLevelsAtTheClosestPoint) {
  int closest = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, FirstLevels::capacity());
    search.Begin(draw.Draw());
    const Hierarchy hierarchy = draw.Draw();
    search.Start(hierarchy);
    const Eigen::VectorXd from = search.y();
    const Sides side = search.side();
    ASSERT_TRUE(search.MeetLevelsBeforeLast(hierarchy));
    EXPECT_EQ(search.side(), side);
    const double tolerance = kSameY * (1 + from.norm());
    EXPECT_LE(Violation(hierarchy, search.y()), tolerance);
    const double distance = (search.y() - from).norm();
    const double least = (FindNearest(hierarchy, from) - from).norm();
    EXPECT_GE(distance, least - tolerance);
    closest += distance <= least + tolerance;
    // The path itself goes on, for the same working set. Only with a limit of time does a
    // solver call MeetLevelsBeforeLast().
    EXPECT_TRUE(search.FollowFromHere(hierarchy, PathBetween::kEnough, 1));
    EXPECT_LE(Violation(hierarchy, search.y()), tolerance);
  }
  EXPECT_GT(closest, 80);
}

// The sum of six bounded variables must become 7, and y is to stay close to zero. One
// iteration adds the sum, with y_i = 7/6; one the three bounds that block next; and one the
// fourth. One finds that y violates nothing, and one solves the levels again.
TEST(NearestOptimum, AddsTheBoundsThatBlockNext) {
  constexpr int kSum = 6;
  const std::vector<LevelCapacity> capacity{{0, 7}, {6, 0}};
  const auto at = [&](double sum) {
    Hierarchy hierarchy(6, capacity);
    InequalityBlock limits = hierarchy.AddInequalities(0, 7);
    limits.C.topRows(6).setIdentity();
    limits.C.row(kSum).setOnes();
    limits.lower.setConstant(-10);
    limits.lower[kSum] = sum;
    limits.upper << 1, 1.02, 1.04, 1.3, 2, 2, 10;
    EqualityBlock task = hierarchy.AddEqualities(1, 6);
    task.B.setIdentity();
    task.B(0, 1) = 1;  // Not a diagonal level.
    hierarchy.FindSpans();
    return hierarchy;
  };
  PathBetween search(6, capacity);
  search.Begin(at(0));
  ASSERT_TRUE(search.MeetLevelsBeforeLast(at(7), 5));
  const Eigen::Matrix<double, 6, 1> y{1, 1.02, 1.04, 1.3, 1.32, 1.32};
  EXPECT_NEAR((search.y() - y).norm(), 0, kSameY);
}

// Bounds that become infinite while the budget ends do not stay in the working set.
TEST(NearestOptimum, MeetsLevelsAfterBoundsBecomeInfinite) {
  int spent = 0;
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, FirstLevels::capacity());
    search.Begin(draw.Draw());
    Hierarchy hierarchy = draw.Draw();
    if (search.MeetLevelsBeforeLast(hierarchy, 2)) continue;
    search.path().Resume(&search.side());
    if (search.Follow(hierarchy, 0)) continue;
    ++spent;
    FitToBounds(hierarchy, &search.side());
    Hierarchy open = draw.Draw(/*open=*/seed % 16);
    FitToBounds(open, &search.side());
    ASSERT_TRUE(search.MeetLevelsBeforeLast(open));
    EXPECT_LE(Violation(open, search.y()), kSameY * (1 + search.y().norm()));
  }
  EXPECT_GT(spent, 20);
}

// A solve that spends its budget on the first levels is followed by one that does not,
// so that the path goes on.
TEST(NearestOptimum, AdvancesThePathAfterMeetingLevels) {
  int spent = 0, spent_again = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, FirstLevels::capacity());
    search.Begin(draw.Draw());
    const Hierarchy hierarchy = draw.Draw();
    const Sides side = search.side();
    if (search.MeetLevelsBeforeLast(hierarchy, 1)) continue;
    ++spent;
    EXPECT_TRUE(search.path().is_paused());
    search.path().Resume(&search.side());
    EXPECT_EQ(search.side(), side);
    EXPECT_TRUE(search.MeetLevelsBeforeLast(hierarchy, 1));
    // Once the path has advanced, the levels are met again first.
    if (!search.Follow(hierarchy, 0)) {
      spent_again += !search.MeetLevelsBeforeLast(hierarchy, 0);
    }
  }
  EXPECT_GT(spent, 50);
  EXPECT_GT(spent_again, 25);
}

}  // namespace
}  // namespace poise
