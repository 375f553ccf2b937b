// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of ParametricSearch::MeetLevelsBeforeLast() and
// PauseAtLevelsBeforeLast().
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "poise/hqp/fast/active_set_search.h"
#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/cost_order.h"
#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/path_between.h"

namespace poise {
namespace {

using Sides = ParametricSearch::Sides;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Relative tolerance of y. The condition of rows of normally distributed
// numbers is below 1e4 in these tests, and multiplies rounding by its square.
constexpr double kSameY = 1e-7;

std::vector<double> ToVector(const Eigen::VectorXd& y) {
  return {y.data(), y.data() + y.size()};
}

// Level 0 has equalities, level 1 limits, level 2 a task, level 3 chooses. All
// numbers are drawn.
class FirstLevels {
 public:
  explicit FirstLevels(int seed, int limits = 16, double bound = 2)
      : bound_(bound), numbers_(seed) {
    for (RowMajorMatrix* matrix : {&B_, &C_, &T_}) {
      *matrix =
          RowMajorMatrix::NullaryExpr(matrix == &C_ ? limits : 3, kVariables,
                                      [&] { return normal_(numbers_); });
    }
  }
  // The first `open` limits are infinite.
  Hierarchy Draw(int open = 0) {
    Hierarchy hierarchy(kVariables, capacity());
    EqualityBlock first = hierarchy.AddEqualities(0, 3);
    first.B = B_;
    for (double& b : first.b) b = normal_(numbers_);
    InequalityBlock limits =
        hierarchy.AddInequalities(1, static_cast<int>(C_.rows()));
    limits.C = C_;
    limits.lower.setConstant(-bound_);
    limits.upper.setConstant(bound_);
    limits.lower.head(open).setConstant(-kInfinity);
    limits.upper.head(open).setConstant(kInfinity);
    EqualityBlock task = hierarchy.AddEqualities(2, 3);
    task.B = T_;
    for (double& b : task.b) b = 5 * normal_(numbers_);
    hierarchy.AddEqualities(3, kVariables).B.setIdentity();
    return hierarchy;
  }
  std::vector<LevelCapacity> capacity() const {
    return {{3, 0}, {0, static_cast<int>(C_.rows())}, {3, 0}, {kVariables, 0}};
  }
  static constexpr int kVariables = 12;

 private:
  double bound_;
  std::mt19937 numbers_;
  std::normal_distribution<double> normal_;
  RowMajorMatrix B_, C_, T_;
};

// Violation of the equalities and limits, the largest one.
double Violation(const Hierarchy& hierarchy, const Eigen::VectorXd& y) {
  const Eigen::VectorXd value = hierarchy.C(1) * y;
  return std::max((hierarchy.B(0) * y + hierarchy.b(0)).cwiseAbs().maxCoeff(),
                  (value - hierarchy.upper(1))
                      .cwiseMax(hierarchy.lower(1) - value)
                      .maxCoeff());
}

// Returns the point closest to `from` that meets levels 0 and 1, found in
// another way: by the cascade, with `from` as the target of the last level.
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

// The point is the first optimum of a working set that violates no bound.
// Mostly this is the closest one.
TEST(NearestOptimum, MeetsLevelsAtANearPoint) {
  int closest = 0, followed = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, draw.capacity());
    search.Begin(draw.Draw());
    const Hierarchy hierarchy = draw.Draw();
    search.Start(hierarchy);
    const Eigen::VectorXd from = search.y();
    const Sides side = search.side();
    ASSERT_TRUE(search.MeetLevelsBeforeLast(hierarchy));
    search.path().Resume(&search.side());
    EXPECT_EQ(search.side(), side);
    // The answer stays as it was if that is better on the last level.
    EXPECT_FALSE(
        IsBetter(hierarchy, ToVector(search.y()), ToVector(search.answer())));
    const double tolerance = kSameY * (1 + from.norm());
    EXPECT_LE(Violation(hierarchy, search.y()), tolerance);
    const double distance = (search.y() - from).norm();
    const double least = (FindNearest(hierarchy, from) - from).norm();
    EXPECT_GE(distance, least - tolerance);
    closest += distance <= least + tolerance;
    // The path itself goes on, for the same working set. Only with a limit of
    // time does a solver call MeetLevelsBeforeLast().
    search.Start(hierarchy);
    if (!search.FollowFromHere(hierarchy, PathBetween::kEnough, 1)) continue;
    ++followed;
    EXPECT_LE(Violation(hierarchy, search.y()), tolerance);
  }
  EXPECT_GT(closest, 60);
  // Rounding differs between builds: 79 with -O3, more than 80 without.
  EXPECT_GT(followed, 70);
}

// The sum of six bounded variables must become 7, and y is to stay close to
// zero. One iteration adds the sum, with y_i = 7/6; one the three bounds that
// block next; and one the fourth. One finds that y violates nothing.
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
  ASSERT_TRUE(search.MeetLevelsBeforeLast(at(7), 4));
  const Eigen::Matrix<double, 6, 1> y{1, 1.02, 1.04, 1.3, 1.32, 1.32};
  EXPECT_NEAR((search.y() - y).norm(), 0, kSameY);
}

// Level 0 fixes y_0 + y_2 and y_1 + y_3, level 1 bounds y_0 and y_1 by 1, and
// both are at their bounds at first. Then the sums get smaller, and y_0 - y_1
// must not exceed -0.5.
TEST(NearestOptimum, RemovesRowsWithALargeNegativeMultiplierFirst) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {0, 3}, {4, 0}};
  const auto at = [&](double sum, double other_sum, double most) {
    Hierarchy hierarchy(4, capacity);
    EqualityBlock sums = hierarchy.AddEqualities(0, 2);
    sums.B << 1, 0, 1, 0, 0, 1, 0, 1;
    sums.b << -sum, -other_sum;
    InequalityBlock limits = hierarchy.AddInequalities(1, 3);
    limits.C << 1, 0, 0, 0, 0, 1, 0, 0, 1, -1, 0, 0;
    limits.lower.setConstant(-kInfinity);
    limits.upper << 1, 1, most;
    EqualityBlock task = hierarchy.AddEqualities(2, 4);
    task.B.setIdentity();
    task.B(0, 1) = 0.1;  // Not a diagonal level.
    task.b << -5, -5, 0, 0;
    hierarchy.FindSpans();
    return hierarchy;
  };
  // The bound of y_1 has 0.01 or 0.36 of the multiplier of that of y_0, which
  // is removed in the first iteration. In the second, y violates nothing.
  for (const double shift : {0.1, 4.0}) {
    SCOPED_TRACE(shift);
    const bool is_large = shift > 1;
    PathBetween search(4, capacity);
    search.Begin(at(1, 1, 10));
    ASSERT_NEAR(search.y()[0] + search.y()[1], 2, kSameY);
    const Hierarchy end = at(1 - 22, 1 - 2 * shift, -0.5);
    ASSERT_TRUE(search.MeetLevelsBeforeLast(end, 2));
    EXPECT_NEAR(search.y()[0], 1 - 11, 20 * kSameY);
    EXPECT_NEAR(search.y()[1], is_large ? 1 - shift : 1, 20 * kSameY);
  }
}

// The targets -1 and -3 of level 1 contradict each other, and y_0 = -2 is the
// optimum. The working set has the bound y_0 <= 0 at first, which keeps y_0
// from it. Its multiplier of level 1 is negative, but that of the distance to
// y = (2, 0) positive.
TEST(NearestOptimum, IsAnOptimumOfALevelThatCannotBeMet) {
  const std::vector<LevelCapacity> capacity{{1, 2}, {2, 0}, {3, 0}};
  const auto at = [&](double sum, double bound, double target) {
    Hierarchy hierarchy(3, capacity);
    EqualityBlock first = hierarchy.AddEqualities(0, 1);
    first.B << 1, 0, 1;
    first.b << -sum;
    InequalityBlock limits = hierarchy.AddInequalities(0, 2);
    limits.C << 1, 0, 0, 0, 1, 0;
    limits.lower.setConstant(-kInfinity);
    limits.upper << 0, bound;
    EqualityBlock targets = hierarchy.AddEqualities(1, 2);
    targets.B << 1, 0, 0, 1, 0, 0;
    targets.b << target + 1, target + 3;
    EqualityBlock task = hierarchy.AddEqualities(2, 3);
    task.B.setIdentity();
    task.B(0, 1) = 0.1;  // Not a diagonal level.
    hierarchy.FindSpans();
    return hierarchy;
  };
  PathBetween search(3, capacity);
  search.Begin(at(0, 1, -10));
  ASSERT_NEAR(search.y()[0], 0, kSameY);
  ASSERT_EQ(search.side()[0][0], Side::kUpper);
  // A path that is continued begins with y_0 and y_1 at their bounds, and
  // violates none.
  for (const bool is_continued : {false, true}) {
    SCOPED_TRACE(is_continued);
    if (is_continued) {
      search.Begin(at(0, 1, -10));
      const Hierarchy before = at(4, -1, -10);
      ASSERT_TRUE(search.MeetLevelsBeforeLast(before));
      ASSERT_NEAR(search.y()[0], 0, kSameY);
      search.path().Resume(&search.side());
      ASSERT_FALSE(search.Follow(before, 0));
      search.path().Pause(search.side());
    }
    ASSERT_TRUE(search.MeetLevelsBeforeLast(at(4, -1, 0)));
    EXPECT_NEAR(search.y()[0], -2, kSameY);
    EXPECT_NEAR(search.y()[1], -1, kSameY);
  }
}

// Limits that cannot all be met are added and removed many times. But groups of
// rows are not removed again and again: without this rule, 37 of 500 searches
// take more than 80 iterations.
TEST(NearestOptimum, SeldomCyclesWhereLimitsCannotBeMet) {
  int endless = 0;
  for (int seed = 0; seed < 500; ++seed) {
    FirstLevels draw(seed, /*limits=*/24, /*bound=*/0.2);
    PathBetween search(FirstLevels::kVariables, draw.capacity());
    search.Begin(draw.Draw());
    endless += !search.MeetLevelsBeforeLast(draw.Draw(), 80);
  }
  // 6, or 13 if any row is removed alone; rounding decides about some of them.
  EXPECT_LT(endless, 11);
}

// Bounds that become infinite while the budget ends do not stay in the working
// set.
TEST(NearestOptimum, MeetsLevelsAfterBoundsBecomeInfinite) {
  int spent = 0;
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, draw.capacity());
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

// A solve that spends its budget on the first levels is followed by one that
// does not, so that the path goes on.
TEST(NearestOptimum, AdvancesThePathAfterMeetingLevels) {
  int spent = 0, spent_again = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, draw.capacity());
    search.Begin(draw.Draw());
    const Hierarchy hierarchy = draw.Draw();
    const Sides side = search.side();
    const auto is_cut_off = [&] {
      const bool is_met = search.MeetLevelsBeforeLast(hierarchy, 1);
      EXPECT_TRUE(is_met || search.path().is_paused());
      search.path().Resume(&search.side());
      EXPECT_EQ(search.side(), side);
      return !is_met;
    };
    if (!is_cut_off() || !is_cut_off()) continue;
    ++spent;
    EXPECT_FALSE(is_cut_off());
    // Once the path has advanced, the levels are met again first.
    if (!search.Follow(hierarchy, 0)) {
      search.path().Pause(search.side());
      spent_again += !search.MeetLevelsBeforeLast(hierarchy, 0);
    }
  }
  EXPECT_GT(spent, 50);
  EXPECT_GT(spent_again, 25);
}

// If a path is continued, the search begins with the working set of the last
// point. It then mostly finds a point in one iteration, and solves the levels
// again in a second one.
TEST(NearestOptimum, BeginsWithTheLastPointIfThePathIsContinued) {
  int longer = 0, paused = 0, at_once = 0;
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    PathBetween search(FirstLevels::kVariables, draw.capacity());
    PathBetween other(FirstLevels::kVariables, draw.capacity());
    const Hierarchy first = draw.Draw(), hierarchy = draw.Draw();
    search.Begin(first);
    other.Begin(first);
    if (other.MeetLevelsBeforeLast(hierarchy, 2)) continue;
    ++longer;
    ASSERT_TRUE(search.MeetLevelsBeforeLast(hierarchy));
    // The path is followed for one iteration, and paused.
    search.path().Resume(&search.side());
    if (search.Follow(hierarchy, 1)) continue;
    ++paused;
    search.path().Pause(search.side());
    if (!search.MeetLevelsBeforeLast(hierarchy, 2)) continue;
    ++at_once;
    // The levels of the path are only solved once.
    EXPECT_EQ(search.problem().work().num_solved, 1);
    EXPECT_LE(Violation(hierarchy, search.answer()),
              kSameY * (1 + search.answer().norm()));
  }
  EXPECT_GT(longer, 20);
  EXPECT_GT(at_once, 0.8 * paused) << paused;
}

// Bounds that keep y_1 at 5 are forgotten by the time when y_0 must move: y_1
// stays at its optimum, whatever the working set of the last search.
TEST(NearestOptimum, DoesNotReturnToAnOldWorkingSet) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {3, 0}};
  const auto at = [&](double most, double least) {
    Hierarchy hierarchy(3, capacity);
    InequalityBlock limits = hierarchy.AddInequalities(0, 2);
    limits.C << 1, 0, 0, 0, 1, 0;
    limits.lower << -kInfinity, least;
    limits.upper << most, kInfinity;
    EqualityBlock task = hierarchy.AddEqualities(1, 3);
    task.B.setIdentity();
    task.B(0, 2) = 0.1;  // Not a diagonal level.
    hierarchy.FindSpans();
    return hierarchy;
  };
  for (const bool forgets : {false, true}) {
    SCOPED_TRACE(forgets);
    PathBetween search(3, capacity);
    search.Begin(at(1000, -10));
    ASSERT_TRUE(search.MeetLevelsBeforeLast(at(-1, 5)));
    ASSERT_NEAR(search.y()[1], 5, kSameY);
    if (forgets) search.path().Forget();
    search.Begin(at(1000, -10));
    ASSERT_NEAR(search.y()[1], 0, kSameY);
    ASSERT_TRUE(search.MeetLevelsBeforeLast(at(-0.1, -10)));
    EXPECT_NEAR(search.y()[0], -0.1, kSameY);
    EXPECT_NEAR(search.y()[1], 0, kSameY);
  }
}

// After a path that has ended within its share, the rest of the time is left,
// for instance for refinement.
TEST(NearestOptimum, LeavesTheRestOfTheTimeAfterAPath) {
  double time = 0;
  const std::function<double()> now = [&] { return time; };
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    WorkingSetProblem problem(FirstLevels::kVariables, draw.capacity());
    ActiveSetSearch search(FirstLevels::kVariables, draw.capacity());
    Sides side = NoSides(draw.capacity());
    for (int tick = 0; tick < 2; ++tick) {
      const Hierarchy hierarchy = draw.Draw();
      int failed_level;
      ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
      FitToBounds(hierarchy, &side);
      time = 0;
      Budget budget({PathBetween::kEnough, 0, 1}, &now);
      ASSERT_TRUE(search.AllAtOnce(hierarchy, PathBetween::kEnough, &budget,
                                   &problem, &side));
      time = 0.9;
      EXPECT_TRUE(budget.Take({}));
    }
  }
}

}  // namespace
}  // namespace poise
