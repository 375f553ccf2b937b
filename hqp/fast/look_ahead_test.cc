// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of the changes that ParametricSearch makes before their times.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/path_between.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-13;  // A few operations on numbers near 1.

// Twelve boxes y_j <= upper_j, and a target for each y_j, but for y_5 plus
// leads_ times the variables before it. By default, the bounds are 1, and y_5
// has a target of its own.
class LookAheadTest : public testing::Test {
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
    MakeLeading(1, &hierarchy);
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
  PathBetween search_{kVariables, capacity_};
};

// Six bounds are reached. One iteration adds four of them, those that are
// reached first; the path itself stops at the first one.
TEST_F(LookAheadTest, AddsRowsAheadInTheOrderOfTheirTimes) {
  search_.Begin(Start());
  Eigen::VectorXd target = Eigen::VectorXd::Zero(kVariables);
  target.head(6) << 7, 6, 5, 4, 3, 2;
  const Hierarchy end = At(target);
  ASSERT_FALSE(search_.Follow(end, 1));
  // The row of the first iteration, three ahead, and the row of the second
  // iteration.
  EXPECT_EQ(NumActive(), 5);
  EXPECT_TRUE(AreSorted(Side::kUpper, Side::kNone));
  ASSERT_TRUE(search_.Follow(end));
  EXPECT_EQ(NumActive(), 6);
  EXPECT_NEAR((search_.y() - target.cwiseMin(1)).norm(), 0, kTolerance);
}

// Twelve rows with the multiplier 0 are removed, four in each iteration:
// nothing moves before.
TEST_F(LookAheadTest, RemovesRowsTogetherWhoseMultiplierIsZero) {
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

// y_5 follows y_0, which stops at 1, so that y_5 does not reach its bound 1.1.
// This bound is added ahead and removed again.
TEST_F(LookAheadTest, LooksAheadAgainAfterFourAdditions) {
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
  // The first iteration adds y_0's bound, the wrong one and two others, and the
  // second removes the wrong one. Four more add one bound each, and the last of
  // them three others. The seventh adds the last bound.
  EXPECT_EQ(search_.iterations(), 7);
}

// All bounds are active at first, and none at the end. Three iterations remove
// one row each, in the order in which the multipliers vanish, and the fourth
// removes all others.
TEST_F(LookAheadTest, RemovesRowsAheadAfterFourRemovals) {
  search_.Begin(At(Eigen::VectorXd::LinSpaced(kVariables, 2, kVariables + 1)));
  ASSERT_EQ(NumActive(), kVariables);
  const Hierarchy end = Start();
  ASSERT_FALSE(search_.Follow(end, 3));
  EXPECT_EQ(NumActive(), kVariables - 3 - 1);  // The fourth is not solved.
  EXPECT_TRUE(AreSorted(Side::kNone, Side::kUpper));
  ASSERT_TRUE(search_.Follow(end, 4));
  EXPECT_EQ(NumActive(), 0);
  EXPECT_NEAR(search_.y().norm(), 0, kTolerance);
}

// y_4 + y_5 is to be 1.7 at the end. The multiplier of y_5's bound vanishes
// soon after that of y_4's, if y_4 stays at its bound. But y_4 then gets -0.15,
// so that y_5 stays at its bound. This bound is removed ahead and added again.
TEST_F(LookAheadTest, AddsARowAgainThatWasRemovedAhead) {
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
  // Four iterations remove rows 0 to 3, and the last of them all others. The
  // fifth adds row 5 again.
  EXPECT_EQ(search_.iterations(), 5);
}

// Rows 0 to 2 are removed, and then row 5, because y_5 is to be 1.1 - y_4 / 2.
// Row 4 is removed with it, and y_4 then gets 0.04 and y_5 its bound. So row 5
// must be added again.
TEST_F(LookAheadTest, AddsTheRowAgainThatWasRemovedBeforeOthers) {
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

// y_5 follows 0.9 y_4 and reaches its bound first. Row 4 is added ahead, and
// y_5 then gets 0.6. So the row that was added first must be removed again.
TEST_F(LookAheadTest, RemovesTheRowThatWasAddedBeforeOthers) {
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

// y is 0 and violates twelve bounds. Three iterations add four of them each,
// and one finds that y violates none.
TEST_F(LookAheadTest, AddsViolatedBoundsTogetherToMeetTheirLevel) {
  PathBetween other(kVariables, capacity_);
  search_.Begin(Start());
  other.Begin(Start());
  upper_.setConstant(-1);
  ASSERT_TRUE(search_.MeetLevelsBeforeLast(Start(), 4));
  EXPECT_NEAR((search_.y() - upper_).norm(), 0, kTolerance);
  EXPECT_FALSE(other.MeetLevelsBeforeLast(Start(), 3));
}

// y_1 follows y_0, with y_0 <= 1 and y_1 <= 1.5. The target of y_0 moves from 0
// to 2, and y_1 would reach its bound if y_0 did not stop before. So this bound
// is added ahead, and must be removed again.
TEST(LookAhead, RemovesARowThatWasAddedAhead) {
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
  PathBetween search(2, capacity);
  search.Begin(at(0));
  ASSERT_TRUE(search.Follow(at(2)));
  // One iteration adds both bounds, and one removes the second.
  EXPECT_EQ(search.iterations(), 2);
  EXPECT_EQ(search.side()[0][0], Side::kUpper);
  EXPECT_EQ(search.side()[0][1], Side::kNone);
  EXPECT_NEAR((search.y() - Eigen::Vector2d(1, 1)).norm(), 0, kTolerance);
}

}  // namespace
}  // namespace poise
