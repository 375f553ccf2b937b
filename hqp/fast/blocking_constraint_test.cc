// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of the steps of ActiveSetSearch in a search that goes on from another
// y.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "poise/hqp/fast/active_set_search.h"
#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A search that goes on from y = 0, although the working set is another one.
class GoingOn {
 public:
  GoingOn(const Hierarchy& hierarchy,
          const std::vector<LevelCapacity>& capacity,
          const std::vector<std::vector<Side>>& side)
      : hierarchy_(hierarchy),
        problem_(hierarchy.num_variables(), capacity),
        search_(hierarchy.num_variables(), capacity),
        side_(side) {
    int failed;
    EXPECT_EQ(problem_.Read(hierarchy, &failed), Status::kOptimal);
    search_.Stop(hierarchy, problem_, &side_);
    side_ = side;
  }
  // Returns whether so many iterations suffice.
  bool Search(int max_iterations) {
    const std::function<double()> no_clock;
    Budget budget({max_iterations}, &no_clock);
    const CountMalloc count;
    const bool is_complete = search_.AllAtOnce(hierarchy_, max_iterations,
                                               &budget, &problem_, &side_);
    EXPECT_EQ(count.allocations(), 0);
    return is_complete;
  }
  Eigen::VectorXd y() const {
    return Eigen::VectorXd::Map(search_.y().data(), search_.y().size());
  }
  Side side(int level, int i) const { return side_[level][i]; }

 private:
  const Hierarchy& hierarchy_;
  WorkingSetProblem problem_;
  ActiveSetSearch search_;
  std::vector<std::vector<Side>> side_;
};

// The rows y_0 <= 2, y_1 <= 2 and y_0 + y_1 <= 3, of which the first two are in
// the working set, and the target (5, 5). The step towards (2, 2) stops at the
// third row, which depends on the other two. If all three were kept, y would go
// to the point that violates each of them least, (5/3, 5/3).
TEST(BlockingConstraint, ReplacesARowThatYIsStrictlyInside) {
  const std::vector<LevelCapacity> capacity{{0, 3}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  InequalityBlock rows = hierarchy.AddInequalities(0, 3);
  rows.C << 1, 0, 0, 1, 1, 1;
  rows.lower.setConstant(-kInfinity);
  rows.upper << 2, 2, 3;
  EqualityBlock target = hierarchy.AddEqualities(1, 2);
  target.B.setIdentity();
  target.b.setConstant(-5);
  bool is_complete = false;
  for (int iterations = 1; !is_complete; ++iterations) {
    ASSERT_LE(iterations, 10);  // It needs 4.
    GoingOn search(hierarchy, capacity,
                   {{Side::kUpper, Side::kUpper, Side::kNone}, {}});
    is_complete = search.Search(iterations);
    EXPECT_LE(search.y().sum(), 3 + Rounding(3, 3)) << iterations;
    if (!is_complete) continue;
    EXPECT_NEAR((search.y() - Eigen::Vector2d(1.5, 1.5)).norm(), 0,
                Rounding(3, 3));
    EXPECT_EQ(search.side(0, 0), Side::kNone);
    EXPECT_EQ(search.side(0, 1), Side::kNone);
    EXPECT_EQ(search.side(0, 2), Side::kUpper);
  }
}

// y = 0 is inside most limits of two levels, and violates four of the first. It
// never gets worse, whichever rows of an independent working set are strictly
// inside their bound.
TEST(BlockingConstraint, NeverViolatesLimitsMore) {
  constexpr int kVariables = 8, kLimits = 24, kViolated = 4, kTask = 3;
  const std::vector<LevelCapacity> capacity{
      {0, kLimits}, {0, kLimits}, {kTask, 0}, {kVariables, 0}};
  std::mt19937 numbers(1);
  std::normal_distribution<double> normal;
  int stopped = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    Hierarchy hierarchy(kVariables, capacity);
    // Fewer rows than variables are independent.
    std::vector<std::vector<Side>> side(4);
    for (const int level : {0, 1}) {
      InequalityBlock limits = hierarchy.AddInequalities(level, kLimits);
      for (double& entry : limits.C.reshaped()) entry = normal(numbers);
      limits.lower.setConstant(-1);
      limits.upper.setConstant(1);
      if (level == 0) limits.lower.tail(kViolated).setConstant(0.1);
      side[level].resize(kLimits, Side::kNone);
      for (int i = 0; i < kVariables / 2 - level; ++i) {
        side[level][i] = normal(numbers) > 0 ? Side::kUpper : Side::kLower;
      }
    }
    EqualityBlock task = hierarchy.AddEqualities(2, kTask);
    for (double& entry : task.B.reshaped()) entry = normal(numbers);
    for (double& entry : task.b) entry = 5 * normal(numbers);
    hierarchy.AddEqualities(3, kVariables).B.setIdentity();
    bool is_complete = false;
    double last[] = {kInfinity, kInfinity};
    for (int iterations = 1; !is_complete; ++iterations) {
      ASSERT_LE(iterations, 200);  // They need 60 at most.
      GoingOn search(hierarchy, capacity, side);
      is_complete = search.Search(iterations);
      stopped += !is_complete;
      const Eigen::VectorXd y = search.y();
      // Rows are 3 long. The condition of eight of them is usually below 1e5.
      const double rounding = Rounding(3 * (1 + y.norm()), kVariables, 1e5);
      for (const int level : {0, 1}) {
        const Eigen::VectorXd value = hierarchy.C(level) * y;
        const double cost = (value - hierarchy.upper(level))
                                .cwiseMax(hierarchy.lower(level) - value)
                                .cwiseMax(0)
                                .squaredNorm();
        const bool is_better = cost < last[level] - rounding;
        ASSERT_LE(cost, last[level] + rounding) << iterations;
        last[level] = cost;
        if (is_better) last[1] = kInfinity;
      }
      if (!is_complete) continue;
      Cascade cascade(kVariables, capacity);
      Solution reference(kVariables, capacity);
      ASSERT_EQ(cascade.Solve(hierarchy, &reference), Status::kOptimal);
      EXPECT_LE((y - reference.y).norm(),
                Rounding(1 + y.norm(), kVariables, 1e5));
    }
  }
  EXPECT_GT(stopped, 1000);
}

// The row y <= 2 of level 0 is in the working set, and the step towards it
// stops at y <= 1 of level 1. If both were kept, y would go to 2, and level 1
// would be violated.
TEST(BlockingConstraint, ReplacesARowOfALevelAbove) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {0, 1}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  for (const int level : {0, 1}) {
    InequalityBlock row = hierarchy.AddInequalities(level, 1);
    row.C(0, 0) = 1;
    row.lower[0] = -kInfinity;
    row.upper[0] = 2 - level;
  }
  EqualityBlock target = hierarchy.AddEqualities(2, 1);
  target.B(0, 0) = 1;
  target.b[0] = -5;
  bool is_complete = false;
  for (int iterations = 1; !is_complete; ++iterations) {
    ASSERT_LE(iterations, 10);  // It needs 3.
    GoingOn search(hierarchy, capacity, {{Side::kUpper}, {Side::kNone}, {}});
    is_complete = search.Search(iterations);
    EXPECT_LE(search.y()[0], 1) << iterations;
  }
}

// Rows of zeros whose bounds exclude 0 cannot be met, and block no step.
TEST(BlockingConstraint, IgnoresRowsOfZeros) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock zero = hierarchy.AddInequalities(0, 2);
  zero.C << 0, 1;
  zero.lower << 1, -kInfinity;
  zero.upper << 2, 1;
  EqualityBlock target = hierarchy.AddEqualities(1, 1);
  target.B(0, 0) = 1;
  target.b[0] = -5;
  GoingOn search(hierarchy, capacity, {{Side::kNone, Side::kNone}, {}});
  EXPECT_TRUE(search.Search(10));
  EXPECT_EQ(search.side(0, 0), Side::kNone);
  EXPECT_EQ(search.y()[0], 1);
}

// Both signs of y.
class ViolatedBoundTest : public testing::TestWithParam<int> {
 protected:
  // Adds a row `entries` y >= bound, or <= -bound for the other sign.
  void AddRow(const Eigen::RowVector2d& entries, double bound) {
    InequalityBlock row = hierarchy_.AddInequalities(0, 1);
    row.C = entries;
    row.lower[0] = sign_ > 0 ? bound : -kInfinity;
    row.upper[0] = sign_ > 0 ? kInfinity : -bound;
  }
  void AddTarget(const Eigen::Vector2d& target) {
    EqualityBlock task = hierarchy_.AddEqualities(1, 2);
    task.B << 1, 1, 1,
        -1;  // With unit vectors, the level would be a diagonal one.
    task.b = -sign_ * task.B * target;
  }

  const int sign_ = GetParam();
  const std::vector<LevelCapacity> capacity_{{0, 2}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
};

// y = 0 violates y_0 >= 1, which is not in the working set. The step towards
// the target (2, 3) meets this bound and stops at -y_1 >= -1; the first bound
// is not added.
TEST_P(ViolatedBoundTest, IsNotAddedIfTheStepMeetsIt) {
  AddRow({1, 0}, 1);
  AddRow({0, -1}, -1);
  AddTarget({2, 3});
  GoingOn search(hierarchy_, capacity_, {{Side::kNone, Side::kNone}, {}});
  // One iteration finds the target, one stops at the bound of y_1, one goes to
  // the optimum, and one solves for the diagonal levels.
  EXPECT_TRUE(search.Search(4));
  EXPECT_EQ(search.side(0, 0), Side::kNone);
  EXPECT_NEAR((search.y() - sign_ * Eigen::Vector2d(2, 1)).norm(), 0,
              Rounding(3, 2));
}

// As before, but the target is (0.5, 0): the step does not meet the bound,
// which blocks at once.
TEST_P(ViolatedBoundTest, IsAddedIfTheStepDoesNotMeetIt) {
  AddRow({1, 0}, 1);
  AddTarget({0.5, 0});
  GoingOn search(hierarchy_, capacity_, {{Side::kNone}, {}});
  ASSERT_TRUE(search.Search(10));  // It needs 4.
  EXPECT_EQ(search.side(0, 0), sign_ > 0 ? Side::kLower : Side::kUpper);
  EXPECT_NEAR((search.y() - sign_ * Eigen::Vector2d(1, 0)).norm(), 0,
              Rounding(1, 2));
}

INSTANTIATE_TEST_SUITE_P(Signs, ViolatedBoundTest, testing::Values(1, -1));

}  // namespace
}  // namespace poise
