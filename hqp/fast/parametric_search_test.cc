// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/parametric_search.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/copy_level.h"
#include "poise/tests/util/path_between.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

using Sides = ParametricSearch::Sides;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-13;  // A few operations on numbers near 1.

// Two variables with y_0 <= 1 and y_1 <= 1, and below a target for both, of
// weight 1. Its rows are not unit vectors, so that the level is a leading one.
class ParametricSearchTest : public testing::Test {
 protected:
  Hierarchy At(double target_0, double target_1, double bound_0 = 1,
               double bound_1 = 1) const {
    Hierarchy hierarchy(2, capacity_);
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C.setIdentity();
    bounds.lower.setConstant(-kInfinity);
    bounds.upper << bound_0, bound_1;
    EqualityBlock task = hierarchy.AddEqualities(1, 2);
    task.B << 1, 1, 1, -1;
    task.b << -target_0 - target_1, target_1 - target_0;
    return hierarchy;
  }
  Side side(int i) { return search_.side()[0][i]; }

  const std::vector<LevelCapacity> capacity_{{0, 2}, {2, 0}};
  PathBetween search_{2, capacity_};
};

// The target moves from (0, 0) to (4, 0), and reaches the bound at a quarter.
TEST_F(ParametricSearchTest, AddsARowWhereThePathReachesItsBound) {
  search_.Begin(At(0, 0));
  const Hierarchy end = At(4, 0);
  EXPECT_FALSE(search_.Follow(end, 0));
  EXPECT_EQ(side(0), Side::kUpper);
  EXPECT_NEAR(search_.y()[0], 1, kTolerance);
  EXPECT_NEAR(search_.y()[1], 0, kTolerance);
}

// The bound holds y_0 = 1 with the multiplier target - 1, which goes from 2 to
// -2. The multiplier is zero at half of the path. There y_1, which is free, is
// 0.25.
TEST_F(ParametricSearchTest, RemovesARowWhereItsMultiplierIsZero) {
  search_.Begin(At(3, 0));
  ASSERT_EQ(side(0), Side::kUpper);
  const Hierarchy end = At(-1, 0.5);
  EXPECT_FALSE(search_.Follow(end, 0));
  EXPECT_EQ(side(0), Side::kNone);
  EXPECT_NEAR(search_.y()[0], 1, kTolerance);
  EXPECT_NEAR(search_.y()[1], 0.25, kTolerance);
}

// The bound on y_0 is removed at a quarter, when y_1 has come from 0 to 0.4, or
// y_1 reaches its bound before, at a fifth.
TEST_F(ParametricSearchTest, MakesTheEarlierChangeFirst) {
  for (const double target : {1.6, 5.0}) {
    PathBetween search(2, capacity_);
    search.Begin(At(2, 0));
    const bool is_removed = target < 2;
    EXPECT_FALSE(search.Follow(At(-2, target), 0));
    EXPECT_EQ(search.side()[0][0], is_removed ? Side::kNone : Side::kUpper);
    EXPECT_EQ(search.side()[0][1], is_removed ? Side::kNone : Side::kUpper);
    EXPECT_NEAR(search.y()[1], is_removed ? 0.4 : 1, kTolerance);
  }
}

// Both rows are removed, at a half and at a quarter, in either order.
TEST_F(ParametricSearchTest, RemovesTheRowWhoseMultiplierVanishesFirst) {
  for (const int first : {0, 1}) {
    PathBetween search(2, capacity_);
    search.Begin(first == 0 ? At(2, 3) : At(3, 2));
    EXPECT_FALSE(search.Follow(first == 0 ? At(-2, -1) : At(-1, -2), 0));
    EXPECT_EQ(search.side()[0][first], Side::kNone);
    EXPECT_EQ(search.side()[0][1 - first], Side::kUpper);
  }
}

// The bounds become 0, so that y = (0.5, 0.5) violates both from the start. The
// end violates one of them by 2 and the other one by 1.
TEST_F(ParametricSearchTest, AddsTheMoreViolatedOfTwoRowsThatBlockAtOnce) {
  for (const int most : {0, 1}) {
    PathBetween search(2, capacity_);
    search.Begin(At(0.5, 0.5));
    EXPECT_FALSE(search.Follow(At(2 - most, 1 + most, 0, 0), 0));
    EXPECT_EQ(search.side()[0][most], Side::kUpper);
    EXPECT_EQ(search.side()[0][1 - most], Side::kNone);
  }
}

// The bound 0 is violated by y_0 = 0.5 from the start, and the target is 0.7.
TEST_F(ParametricSearchTest, AddsAViolatedBoundAtOnce) {
  search_.Begin(At(0.5, 0));
  const Hierarchy end = At(0.7, 1, 0);
  EXPECT_FALSE(search_.Follow(end, 0));
  EXPECT_EQ(side(0), Side::kUpper);
  EXPECT_NEAR(search_.y()[0], 0.5, kTolerance);
  EXPECT_NEAR(search_.y()[1], 0, kTolerance);
}

// Only the start violates this bound.
TEST_F(ParametricSearchTest, DoesNotAddABoundThatTheEndMeets) {
  search_.Begin(At(0.5, 0));
  EXPECT_TRUE(search_.Follow(At(-1, 0, 0)));
  EXPECT_EQ(side(0), Side::kNone);
  EXPECT_EQ(search_.iterations(), 0);
}

TEST_F(ParametricSearchTest, TakesNoIterationIfNothingChanges) {
  const Hierarchy hierarchy = At(3, 0.5);
  search_.Begin(hierarchy);
  EXPECT_TRUE(search_.Follow(hierarchy));
  EXPECT_EQ(search_.iterations(), 0);
  EXPECT_NEAR(search_.y()[0], 1, kTolerance);
  EXPECT_NEAR(search_.y()[1], 0.5, kTolerance);
}

// The bound on y_0 is removed from the working set, and the path is paused. On
// the rest of the path, the multiplier of this bound is zero at the start,
// although it was 1.6 before. With the cost
//     5/8 (y_0 - t_0)^2 - 3/4 (y_0 - t_0) (y_1 - t_1) + 5/8 (y_1 - t_1)^2:
// 1. The target of y_0 violates its bound. y_0 is at this bound, so that the
//    bound is added at time 0. Its multiplier would be 2/5 at the end, with
//    y_1 = 2.7.
// 2. y_1 goes from -1.2 to its bound 1, which is added. There, y_2 is the time.
// 3. From then on, the multiplier of the bound on y_0 decreases towards -7/8.
//    Where it is zero, the bound is removed.
TEST(ParametricSearch, ForgetsTheMultiplierOfARowThatIsRemovedBeforeAPause) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {3, 0}};
  const auto at = [&](const Eigen::Vector3d& target) {
    Hierarchy hierarchy(3, capacity);
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C.setIdentity();
    bounds.lower.setConstant(-kInfinity);
    bounds.upper.setConstant(1);
    EqualityBlock task = hierarchy.AddEqualities(1, 3);
    task.B << 0.5, 0.5, 0, 1, -1, 0, 0, 0, 1;
    task.b = -task.B * target;
    return hierarchy;
  };
  PathBetween search(3, capacity);
  search.Begin(at({3, 0, 0}));
  ASSERT_EQ(search.side()[0][0], Side::kUpper);
  ASSERT_NEAR(search.y()[1], -1.2, kTolerance);
  search.side()[0][0] = Side::kNone;
  search.path().Pause(search.side());
  EXPECT_FALSE(search.Follow(at({1.5, 3, 1}), 2));
  EXPECT_EQ(search.side()[0][0], Side::kNone);
  EXPECT_EQ(search.side()[0][1], Side::kUpper);
  const double time = (1 + 1.2) / (2.7 + 1.2);
  const double multiplier = time * 2 / 5;
  const double removal = multiplier / (multiplier + 7.0 / 8);
  EXPECT_NEAR(search.y()[2], time + removal * (1 - time), kTolerance);
}

TEST_F(ParametricSearchTest, GoesOnAfterAPause) {
  search_.Begin(At(0, 3));
  const Hierarchy end = At(3, 0);
  EXPECT_FALSE(search_.Follow(end, 0));
  search_.path().Pause(search_.side());
  EXPECT_TRUE(search_.path().is_paused());
  Sides resumed = NoSides(capacity_);
  search_.path().Resume(&resumed);
  EXPECT_EQ(resumed, search_.side());
  EXPECT_FALSE(search_.Follow(end, 0));  // The other row changes.
  EXPECT_TRUE(search_.Follow(end));
  EXPECT_NEAR(search_.y()[0], 1, kTolerance);
  EXPECT_NEAR(search_.y()[1], 0, kTolerance);
  EXPECT_EQ(side(0), Side::kUpper);
  EXPECT_EQ(side(1), Side::kNone);
}

TEST_F(ParametricSearchTest, ForgetsThePath) {
  search_.Begin(At(0, 0));
  EXPECT_TRUE(search_.path().is_known());
  search_.path().Pause(search_.side());
  search_.path().Forget();
  EXPECT_FALSE(search_.path().is_known());
  EXPECT_FALSE(search_.path().is_paused());
}

// A polygon of 40 sides around the unit circle, and a target at a distance of 3
// in the direction of the middle of a side. When the target turns, the path
// goes along the polygon: it adds a side at each corner, and then removes the
// one before.
class PolygonTest : public testing::Test {
 protected:
  static constexpr int kCorners = 40;

  static Eigen::Vector2d Middle(int i, double turn = 0) {
    // No side is parallel to an axis: such sides are added ahead.
    const double angle = 0.05 + turn + 2 * M_PI * i / kCorners;
    return {std::cos(angle), std::sin(angle)};
  }
  // Each further polygon is turned a little, in two more variables.
  static Hierarchy Towards(int i, int polygons = 1) {
    Hierarchy hierarchy(2 * polygons, Capacity(polygons));
    for (int k = 0; k < polygons; ++k) {
      InequalityBlock polygon = hierarchy.AddInequalities(0, kCorners);
      for (int row = 0; row < kCorners; ++row) {
        polygon.C.row(row).segment<2>(2 * k) = Middle(row, 0.02 * k);
      }
      polygon.lower.setConstant(-kInfinity);
      polygon.upper.setOnes();
      // With unit vectors as rows, the level would be a diagonal one.
      EqualityBlock task = hierarchy.AddEqualities(1, 2);
      task.B.middleCols<2>(2 * k) << 1, 1, 1, -1;
      task.b = -3 * task.B.middleCols<2>(2 * k) * Middle(i);
    }
    return hierarchy;
  }
  static std::vector<LevelCapacity> Capacity(int polygons) {
    return {{0, kCorners * polygons}, {2 * polygons, 0}};
  }

  const std::vector<LevelCapacity> capacity_ = Capacity(1);
};

TEST_F(PolygonTest, IsGivenUpAfterManyCorners) {
  for (const int corners : {1, 2, 3, 14, 15}) {
    SCOPED_TRACE(corners);
    PathBetween search(2, capacity_);
    search.Begin(Towards(0));
    const bool is_optimal = search.Follow(Towards(corners));
    EXPECT_EQ(is_optimal, corners < 4);
    // Each corner needs two changes.
    EXPECT_LE(search.iterations(), 2 * corners);
    if (is_optimal) {
      EXPECT_NEAR((search.y() - Middle(corners)).norm(), 0, 10 * kTolerance);
    }
  }
}

// Two polygons are turned against each other by an eighth of the angle of a
// side, so that two sides are added, and then two removed.
TEST_F(PolygonTest, IsFollowedIfTwoRowsInARowChangeInOneDirection) {
  PathBetween search(4, Capacity(2));
  search.Begin(Towards(0, 2));
  ASSERT_TRUE(search.Follow(Towards(15, 2)));
  EXPECT_NEAR((search.y().head<2>() - Middle(15)).norm(), 0, 10 * kTolerance);
}

// A limit of time that is not reached changes nothing.
TEST_F(PolygonTest, IsGivenUpWithALimitOfTimeAsWell) {
  for (const int corners : {3, 15}) {
    PathBetween search(2, capacity_);
    search.Begin(Towards(0));
    const Hierarchy end = Towards(corners);
    search.Start(end);
    EXPECT_EQ(search.FollowFromHere(end, PathBetween::kEnough, 1), corners < 4);
  }
}

TEST_F(PolygonTest, IsSolvedAfterThePathIsGivenUp) {
  Solver solver(2, capacity_);
  Solution solution(2, capacity_);
  for (const double limit : {0, 1}) {
    solver.max_modelled_seconds = limit;
    for (const int i : {0, 15, 30, 16, 31}) {
      ASSERT_EQ(solver.Solve(Towards(i), &solution), Status::kOptimal);
      EXPECT_NEAR((solution.y - Middle(i)).norm(), 0, 10 * kTolerance);
    }
  }
}

// Changes targets and bounds, some of them enough to change the working set.
HierarchyCase Perturb(const HierarchyCase& from, std::mt19937* numbers) {
  HierarchyCase to = from;
  std::uniform_real_distribution<double> change(-1, 1);
  Hierarchy changed(from.hierarchy.num_variables(), from.capacity);
  for (int k = 0; k < from.hierarchy.num_levels(); ++k) {
    auto [rows, limits] = CopyLevel(from.hierarchy, k, &changed);
    for (double& b : rows.b) b += change(*numbers);
    for (int i = 0; i < limits.C.rows(); ++i) {
      const double shift = change(*numbers);
      limits.lower[i] += shift;
      limits.upper[i] += shift;
    }
  }
  to.hierarchy = changed;
  return to;
}

// Each path has three ticks. All paths reach the optimum.
TEST(ParametricSearch, ArrivesAtTheOptimumOfTheCascade) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  int paths = 0, arrived = 0, changes = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 numbers(seed);
    HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    PathBetween search(n, drawn.capacity);
    search.Begin(drawn.hierarchy);
    for (int tick = 0; tick < 3; ++tick) {
      drawn = Perturb(drawn, &numbers);
      const Hierarchy& hierarchy = drawn.hierarchy;
      ++paths;
      const Sides before = search.side();
      if (!search.Follow(hierarchy)) break;
      ++arrived;
      changes += search.side() != before;
      search.path().Remember(search.problem(), search.side());
      Cascade cascade(n, drawn.capacity);
      Solution reference(n, drawn.capacity), found(n, drawn.capacity);
      ASSERT_EQ(cascade.Solve(hierarchy, &reference), Status::kOptimal);
      found.y = search.y();
      for (int level = 0; level < hierarchy.num_levels(); ++level) {
        EvaluateLevel(hierarchy, level, &found);
        EXPECT_NEAR(
            found.levels[level].cost, reference.levels[level].cost,
            Certifier::kCertified * CostSize(hierarchy, level, reference))
            << tick << ", " << level;
      }
    }
  }
  EXPECT_EQ(arrived, paths);
  EXPECT_GT(changes, paths / 4);
}

}  // namespace
}  // namespace poise
