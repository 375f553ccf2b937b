// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/parametric_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/fast/active_set_search.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Sides = ParametricSearch::Sides;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-13;  // A few operations on numbers near 1.
constexpr int kEnough = 1000;         // Iterations.

// Relative tolerance of y. The condition of rows of normally distributed numbers is
// below 1e4 in these tests, and multiplies rounding by its square.
constexpr double kSameY = 1e-7;

Sides NoSides(const std::vector<LevelCapacity>& capacity) {
  Sides side;
  for (const LevelCapacity& level : capacity) {
    side.emplace_back(level.inequalities, Side::kNone);
  }
  return side;
}

// A path between two hierarchies of the same rows.
class Search {
 public:
  Search(int n, const std::vector<LevelCapacity>& capacity)
      : n_(n),
        problem_(n, capacity),
        search_(n, capacity),
        path_(n, capacity),
        side_(NoSides(capacity)) {}

  // Finds the optimum without a path, and remembers it.
  void Begin(const Hierarchy& hierarchy) {
    Budget budget({kEnough}, &no_clock_);
    Read(hierarchy);
    FitToBounds(hierarchy, &side_);
    ASSERT_TRUE(
        search_.AllAtOnce(hierarchy, kEnough, &budget, &problem_, &side_));
    *path_.mutable_y() = search_.y();
    path_.Remember(problem_, side_);
  }
  bool Follow(const Hierarchy& hierarchy, int limit = kEnough) {
    Start(hierarchy);
    return FollowFromHere(hierarchy, limit);
  }
  // Follows the path if the leading levels are solved already.
  bool FollowFromHere(const Hierarchy& hierarchy, int limit = kEnough) {
    Budget budget({limit}, &no_clock_);
    problem_.SolveDiagonal();
    const CountMalloc count;
    const bool is_optimal =
        path_.Follow(hierarchy, limit, &budget, &problem_, &side_);
    EXPECT_EQ(count.allocations(), 0);
    iterations_ = budget.iterations();
    return is_optimal;
  }
  bool MeetLevelsBeforeLast(const Hierarchy& hierarchy, int limit = kEnough) {
    Budget budget({limit}, &no_clock_);
    Start(hierarchy);
    const CountMalloc count;
    const bool is_met = path_.MeetLevelsBeforeLast(hierarchy, limit, &budget,
                                                   &problem_, &side_);
    EXPECT_EQ(count.allocations(), 0);
    return is_met;
  }
  void Read(const Hierarchy& hierarchy) {
    int failed_level;
    ASSERT_EQ(problem_.Read(hierarchy, &failed_level), Status::kOptimal);
  }
  void Start(const Hierarchy& hierarchy) {
    Read(hierarchy);
    problem_.Plan(hierarchy, hierarchy.num_levels());
    problem_.Start(hierarchy, side_, path_.mutable_y());
  }

  Eigen::VectorXd y() const {
    return Eigen::VectorXd::Map(path_.y().data(), n_);
  }
  ParametricSearch& path() { return path_; }
  const WorkingSetProblem& problem() const { return problem_; }
  Sides& side() { return side_; }
  int iterations() const { return iterations_; }

 private:
  int n_, iterations_ = 0;
  const std::function<double()> no_clock_;
  WorkingSetProblem problem_;
  ActiveSetSearch search_;
  ParametricSearch path_;
  Sides side_;
};

// Two variables with y_0 <= 1 and y_1 <= 1, and below a target for both, with weight
// 1. Its rows are not unit vectors, so that the level is a leading one.
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
  Search search_{2, capacity_};
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

// The bound holds y_0 = 1 with the multiplier target - 1, which goes from 2 to -2. The
// multiplier is zero at half of the path. There y_1, which is free, is 0.25.
TEST_F(ParametricSearchTest, RemovesARowWhereItsMultiplierIsZero) {
  search_.Begin(At(3, 0));
  ASSERT_EQ(side(0), Side::kUpper);
  const Hierarchy end = At(-1, 0.5);
  EXPECT_FALSE(search_.Follow(end, 0));
  EXPECT_EQ(side(0), Side::kNone);
  EXPECT_NEAR(search_.y()[0], 1, kTolerance);
  EXPECT_NEAR(search_.y()[1], 0.25, kTolerance);
}

// The bound on y_0 is removed at a quarter, when y_1 has come from 0 to 0.4, or y_1
// reaches its bound before, at a fifth.
TEST_F(ParametricSearchTest, MakesTheEarlierChangeFirst) {
  for (const double target : {1.6, 5.0}) {
    Search search(2, capacity_);
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
    Search search(2, capacity_);
    search.Begin(first == 0 ? At(2, 3) : At(3, 2));
    EXPECT_FALSE(search.Follow(first == 0 ? At(-2, -1) : At(-1, -2), 0));
    EXPECT_EQ(search.side()[0][first], Side::kNone);
    EXPECT_EQ(search.side()[0][1 - first], Side::kUpper);
  }
}

// The bounds become 0, so that y = (0.5, 0.5) violates both from the start. The end
// violates one of them by 2 and the other one by 1.
TEST_F(ParametricSearchTest, AddsTheMoreViolatedOfTwoRowsThatBlockAtOnce) {
  for (const int most : {0, 1}) {
    Search search(2, capacity_);
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

// Twelve boxes y_j <= upper_j, and a target for each y_j, but for y_5 plus leads_ times the
// variables before it. By default, the bounds are 1, and y_5 has a target of its own.
class ParametricSearchBoxesTest : public testing::Test {
 protected:
  static constexpr int kVariables = 12, kFollower = 5, kLeaders = kFollower;

  Hierarchy At(const Eigen::VectorXd& target) const {
    Hierarchy hierarchy(kVariables, capacity_);
    InequalityBlock bounds = hierarchy.AddInequalities(0, kVariables);
    bounds.C.setIdentity();
    bounds.lower.setConstant(-kInfinity);
    bounds.upper = upper_;
    EqualityBlock task = hierarchy.AddEqualities(1, kVariables);
    task.B.setIdentity();
    task.B.block<1, kLeaders>(kFollower, 0) = leads_;
    task.b = -target;
    // With an inequality, the level is a leading one.
    InequalityBlock loose = hierarchy.AddInequalities(1, 1);
    loose.C.setOnes();
    loose.lower.setConstant(-kInfinity);
    loose.upper.setConstant(kInfinity);
    hierarchy.FindSpans();
    return hierarchy;
  }
  Hierarchy Start() const { return At(Eigen::VectorXd::Zero(kVariables)); }
  int NumActive() {
    const std::vector<Side>& side = search_.side()[0];
    return static_cast<int>(std::count(side.begin(), side.end(), Side::kUpper));
  }

  // Returns whether all rows with the side `first` precede those with `second`.
  bool AreSorted(Side first, Side second) {
    const std::vector<Side>& side = search_.side()[0];
    return std::is_sorted(side.begin(), side.end(), [=](Side x, Side y) {
      return x == first && y == second;
    });
  }

  Eigen::VectorXd upper_ = Eigen::VectorXd::Ones(kVariables);
  Eigen::Matrix<double, 1, kLeaders> leads_ =
      Eigen::Matrix<double, 1, kLeaders>::Zero();
  const std::vector<LevelCapacity> capacity_{{0, kVariables}, {kVariables, 1}};
  Search search_{kVariables, capacity_};
};

// Six bounds are reached. One iteration adds four of them, those that are reached first;
// the path itself stops at the first one.
TEST_F(ParametricSearchBoxesTest, AddsRowsAheadInTheOrderOfTheirTimes) {
  search_.Begin(Start());
  Eigen::VectorXd target = Eigen::VectorXd::Zero(kVariables);
  target.head(6) << 7, 6, 5, 4, 3, 2;
  const Hierarchy end = At(target);
  ASSERT_FALSE(search_.Follow(end, 1));
  // The row of the first iteration, three ahead, and the row of the second iteration.
  EXPECT_EQ(NumActive(), 5);
  EXPECT_TRUE(AreSorted(Side::kUpper, Side::kNone));
  ASSERT_TRUE(search_.Follow(end));
  EXPECT_EQ(NumActive(), 6);
  EXPECT_NEAR((search_.y() - target.cwiseMin(1)).norm(), 0, kTolerance);
}

// Twelve rows with the multiplier 0 are removed, four in each iteration: nothing moves
// before.
TEST_F(ParametricSearchBoxesTest, RemovesRowsTogetherWhoseMultiplierIsZero) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(kVariables);
  search_.Begin(At(ones));
  std::fill(search_.side()[0].begin(), search_.side()[0].end(), Side::kUpper);
  const Hierarchy end = At(-ones);
  ASSERT_FALSE(search_.Follow(end, 1));
  EXPECT_EQ(NumActive(),
            kVariables - 2 * 4);  // The second change is not solved.
  ASSERT_TRUE(search_.Follow(end));
  EXPECT_EQ(search_.iterations(), 1);
  EXPECT_EQ(NumActive(), 0);
  EXPECT_NEAR((search_.y() + ones).norm(), 0, kTolerance);
}

// y_5 follows y_0, which stops at 1, so that y_5 does not reach its bound 1.1. This bound
// is added ahead and removed again.
TEST_F(ParametricSearchBoxesTest, LooksAheadAgainAfterFourAdditions) {
  leads_[0] = -1;
  upper_.setConstant(3);
  upper_[0] = 1;
  upper_[kFollower] = 1.1;
  search_.Begin(Start());
  Eigen::VectorXd target(kVariables), y = upper_;
  target << 4, 11, 10.5, 10, 9.5, 0, 9, 8.5, 8, 7.5, 7, 6.5;
  y[kFollower] = 1;
  ASSERT_TRUE(search_.Follow(At(target)));
  EXPECT_NEAR((search_.y() - y).norm(), 0, 20 * kTolerance);  // |y| is 10.
  // The first iteration adds y_0's bound, the wrong one and two others, and the second
  // removes the wrong one. Four more add one bound each, and the last of them three
  // others. The seventh adds the last bound.
  EXPECT_EQ(search_.iterations(), 7);
}

// All bounds are active at first, and none at the end. Four iterations remove one row
// each, and the fourth removes three more: those whose multiplier vanishes next.
TEST_F(ParametricSearchBoxesTest, RemovesRowsAheadAfterFourRemovals) {
  search_.Begin(At(Eigen::VectorXd::LinSpaced(kVariables, 2, kVariables + 1)));
  ASSERT_EQ(NumActive(), kVariables);
  const Hierarchy end = Start();
  ASSERT_FALSE(search_.Follow(end, 4));
  EXPECT_EQ(NumActive(),
            kVariables - 4 - 3 - 1);  // The last one is removed alone.
  EXPECT_TRUE(AreSorted(Side::kNone, Side::kUpper));
  ASSERT_TRUE(search_.Follow(end));
  EXPECT_EQ(NumActive(), 0);
  EXPECT_NEAR(search_.y().norm(), 0, kTolerance);
}

// y_4 + y_5 is to be 1.7 at the end. The multiplier of y_5's bound vanishes soon after that
// of y_4's, if y_4 stays at its bound. But y_4 then gets -0.15, so that y_5 stays at its
// bound. This bound is removed ahead and added again.
TEST_F(ParametricSearchBoxesTest, AddsARowAgainThatWasRemovedAhead) {
  leads_[kFollower - 1] = 1;
  Eigen::VectorXd start(kVariables), end = Eigen::VectorXd::Zero(kVariables);
  // Except for rows 4 and 5, the multipliers vanish in the order of the rows.
  start << 1.1, 1.2, 1.3, 1.4, 1.8, 2.3, 4, 5, 6, 7, 8, 9;
  end[kFollower - 1] = -1;
  end[kFollower] = 1.7;
  search_.Begin(At(start));
  ASSERT_EQ(NumActive(), kVariables);
  ASSERT_TRUE(search_.Follow(At(end)));
  EXPECT_EQ(NumActive(), 1);
  EXPECT_EQ(search_.side()[0][kFollower], Side::kUpper);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(kVariables);
  y[kFollower - 1] = -0.15;
  y[kFollower] = 1;
  EXPECT_NEAR((search_.y() - y).norm(), 0, kTolerance);
  // Four iterations remove rows 0 to 3, and the last of them rows 4 to 6. The fifth adds
  // row 5 again. Four more remove rows 7 to 10, and the last of them row 11.
  EXPECT_EQ(search_.iterations(), 9);
}

// Rows 0 to 2 are removed, and then row 5, because y_5 is to be 1.1 - y_4 / 2. Row 4 is
// removed with it, and y_4 then gets 0.04 and y_5 its bound. So row 5 must be added again.
TEST_F(ParametricSearchBoxesTest, AddsTheRowAgainThatWasRemovedBeforeOthers) {
  leads_[kFollower - 1] = 0.5;
  Eigen::VectorXd start = Eigen::VectorXd::Constant(kVariables, 3);
  Eigen::VectorXd end = start, y = Eigen::VectorXd::Ones(kVariables);
  start.head(3) << 1.1, 1.2, 1.3;
  start[kFollower] = 1.8;
  end.head(kFollower) << 0, 0, 0, 3, 0;
  end[kFollower] = 1.1;
  y.head(kFollower) << 0, 0, 0, 1, 0.04;
  search_.Begin(At(start));
  ASSERT_EQ(NumActive(), kVariables);
  ASSERT_TRUE(search_.Follow(At(end)));
  EXPECT_NEAR((search_.y() - y).norm(), 0, kTolerance);
}

// y_5 follows 0.9 y_4 and reaches its bound first. Row 4 is added ahead, and y_5 then gets
// 0.6. So the row that was added first must be removed again.
TEST_F(ParametricSearchBoxesTest, RemovesTheRowThatWasAddedBeforeOthers) {
  leads_[kFollower - 1] = -0.9;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(kVariables);
  Eigen::VectorXd end = start, y = start;
  start[kFollower] = 0.9;
  end.segment(kFollower - 1, 2) << 2, -0.3;
  y.segment(kFollower - 1, 2) << 1, 0.6;
  search_.Begin(At(start));
  ASSERT_TRUE(search_.Follow(At(end)));
  EXPECT_NEAR((search_.y() - y).norm(), 0, kTolerance);
}

// y is 0 and violates twelve bounds. Three iterations add four of them each, one finds that
// y violates none, and one solves the levels again.
TEST_F(ParametricSearchBoxesTest, AddsViolatedBoundsTogetherToMeetTheirLevel) {
  Search other(kVariables, capacity_);
  search_.Begin(Start());
  other.Begin(Start());
  upper_.setConstant(-1);
  ASSERT_TRUE(search_.MeetLevelsBeforeLast(Start(), 5));
  EXPECT_NEAR((search_.y() - upper_).norm(), 0, kTolerance);
  EXPECT_FALSE(other.MeetLevelsBeforeLast(Start(), 4));
}

// y_1 follows y_0, with y_0 <= 1 and y_1 <= 1.5. The target of y_0 moves from 0 to 2, and
// y_1 would reach its bound if y_0 did not stop before. So this bound is added ahead, and
// must be removed again.
TEST(ParametricSearch, RemovesARowThatWasAddedAhead) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {2, 0}};
  const auto at = [&](double target) {
    Hierarchy hierarchy(2, capacity);
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C.setIdentity();
    bounds.lower.setConstant(-kInfinity);
    bounds.upper << 1, 1.5;
    EqualityBlock task = hierarchy.AddEqualities(1, 2);
    task.B << 1, 0, -1, 1;
    task.b << -target, 0;
    hierarchy.FindSpans();
    return hierarchy;
  };
  Search search(2, capacity);
  search.Begin(at(0));
  ASSERT_TRUE(search.Follow(at(2)));
  // One iteration adds both bounds, and one removes the second.
  EXPECT_EQ(search.iterations(), 2);
  EXPECT_EQ(search.side()[0][0], Side::kUpper);
  EXPECT_EQ(search.side()[0][1], Side::kNone);
  EXPECT_NEAR((search.y() - Eigen::Vector2d(1, 1)).norm(), 0, kTolerance);
}

// The bound on y_0 is removed from the working set, and the path is paused. On the rest
// of the path, the multiplier of this bound is zero at the start, although it was 1.6
// before. With the cost
//     5/8 (y_0 - t_0)^2 - 3/4 (y_0 - t_0) (y_1 - t_1) + 5/8 (y_1 - t_1)^2:
// 1. The target of y_0 violates its bound. y_0 is at this bound, so that the bound is
//    added at time 0. Its multiplier would be 2/5 at the end, with y_1 = 2.7.
// 2. y_1 goes from -1.2 to its bound 1, which is added. There, y_2 is the time.
// 3. From then on, the multiplier of the bound on y_0 decreases towards -7/8. Where it is
//    zero, the bound is removed.
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
  Search search(3, capacity);
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

// Changes targets and bounds, some of them enough to change the working set.
HierarchyCase Perturb(const HierarchyCase& from, std::mt19937* numbers) {
  HierarchyCase to = from;
  std::uniform_real_distribution<double> change(-1, 1);
  Hierarchy changed(from.hierarchy.num_variables(), from.capacity);
  for (int k = 0; k < from.hierarchy.num_levels(); ++k) {
    EqualityBlock rows =
        changed.AddEqualities(k, from.hierarchy.num_equalities(k));
    rows.B = from.hierarchy.B(k);
    rows.b = from.hierarchy.b(k);
    rows.weight = from.hierarchy.weight(k);
    for (double& b : rows.b) b += change(*numbers);
    InequalityBlock limits =
        changed.AddInequalities(k, from.hierarchy.num_inequalities(k));
    limits.C = from.hierarchy.C(k);
    limits.lower = from.hierarchy.lower(k);
    limits.upper = from.hierarchy.upper(k);
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
    Search search(n, drawn.capacity);
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
TEST(ParametricSearch, MeetsLevelsAtTheClosestPoint) {
  int closest = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    Search search(FirstLevels::kVariables, FirstLevels::capacity());
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
    // The path itself goes on, for the same working set.
    EXPECT_TRUE(search.FollowFromHere(hierarchy));
    EXPECT_LE(Violation(hierarchy, search.y()), tolerance);
  }
  EXPECT_GT(closest, 80);
}

// Bounds that become infinite while the budget ends do not stay in the working set.
TEST(ParametricSearch, MeetsLevelsAfterBoundsBecomeInfinite) {
  int spent = 0;
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    Search search(FirstLevels::kVariables, FirstLevels::capacity());
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
TEST(ParametricSearch, AdvancesThePathAfterMeetingLevels) {
  int spent = 0, spent_again = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    FirstLevels draw(seed);
    Search search(FirstLevels::kVariables, FirstLevels::capacity());
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
