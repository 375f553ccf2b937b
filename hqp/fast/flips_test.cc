// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of rows that ParametricSearch moves from one bound to the other.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/path_between.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Thirteen boxes |y_j| <= 1, and a target for each y_j, plus coupling_ times
// the others. The targets move from 100 + 10 j to -100, so that y_j leaves its
// upper bound in the order of j and reaches the lower one before the next y_j
// leaves. With sign_ = -1, all numbers have the other sign.
class FlipTest : public testing::Test {
 protected:
  static constexpr int kVariables = 13;
  // Targets and residuals are up to 221.
  const double tolerance_ = Rounding(221, kVariables);

  Hierarchy At(const Eigen::VectorXd& target) const {
    Hierarchy hierarchy(kVariables, capacity_);
    InequalityBlock bounds = hierarchy.AddInequalities(0, kVariables);
    bounds.C = C_;
    const Eigen::VectorXd upper = Eigen::VectorXd::Ones(kVariables);
    bounds.lower = sign_ > 0 ? lower_ : Eigen::VectorXd(-upper);
    bounds.upper = sign_ > 0 ? upper : Eigen::VectorXd(-lower_);
    EqualityBlock task = hierarchy.AddEqualities(1, kVariables);
    task.B = coupling_;
    task.B.diagonal().array() += 1;
    task.b = -sign_ * target;
    MakeLeading(1, &hierarchy);
    hierarchy.FindSpans();
    return hierarchy;
  }
  // Follows the path, and returns the number of its iterations.
  int Follow() {
    search_.Begin(At(start_));
    EXPECT_TRUE(search_.Follow(At(end_)));
    return search_.iterations();
  }

  double sign_ = 1;
  Eigen::VectorXd start_ = Eigen::VectorXd::LinSpaced(kVariables, 100, 220);
  Eigen::VectorXd end_ = Eigen::VectorXd::Constant(kVariables, -100);
  Eigen::VectorXd lower_ = -Eigen::VectorXd::Ones(kVariables);
  Eigen::MatrixXd C_ = Eigen::MatrixXd::Identity(kVariables, kVariables);
  Eigen::MatrixXd coupling_ = Eigen::MatrixXd::Zero(kVariables, kVariables);
  const std::vector<LevelCapacity> capacity_{{0, kVariables}, {kVariables, 1}};
  PathBetween search_{kVariables, capacity_};
};

// Two iterations take the first row to its other bound. Two more flip one row
// each, and two flip four: a row and three ahead. One flips the last two.
// Without flips, these would be 26 iterations.
TEST_F(FlipTest, MovesRowsToTheirOtherBound) {
  for (const double sign : {1, -1}) {
    sign_ = sign;
    search_.path().Forget();
    EXPECT_EQ(Follow(), 2 + 2 + 2 + 1) << sign;
    for (const Side side : search_.side()[0]) {
      EXPECT_EQ(side, sign > 0 ? Side::kLower : Side::kUpper);
    }
    EXPECT_NEAR((search_.y() - sign * lower_).norm(), 0, tolerance_) << sign;
  }
}

// The next path begins with a flip.
TEST_F(FlipTest, PredictsFlipsInTheNextPath) {
  end_.tail(kVariables - 1) = start_.tail(kVariables - 1);
  EXPECT_EQ(Follow(), 2);
  EXPECT_EQ(Follow(), 1);
  EXPECT_NEAR(search_.y()[0], -1, tolerance_);
  search_.path().Forget();
  EXPECT_EQ(Follow(), 2);
  EXPECT_NEAR(search_.y()[0], -1, tolerance_);
}

// Another row blocks first. It has not come from its other bound.
TEST_F(FlipTest, PredictsNoFlipsFromOtherRowsThatBlock) {
  start_[0] = 0;
  end_.tail(kVariables - 1) = start_.tail(kVariables - 1);
  end_[1] = 0.5;
  EXPECT_EQ(Follow(), 2);
  EXPECT_NEAR(search_.y()[1], 0.5, tolerance_);
}

// All y_j but the first stay between their bounds. The second row is flipped
// and removed again. After that, rows are only removed, and the fourth removal
// in a row removes eight more. The fifth removes the last row.
TEST_F(FlipTest, RemovesARowThatWasFlippedByMistake) {
  end_.tail(kVariables - 1) *= 0.005;
  EXPECT_EQ(Follow(), 2 + 1 + 4);
  Eigen::VectorXd y = end_;
  y[0] = -1;
  EXPECT_NEAR((search_.y() - y).norm(), 0, tolerance_);
}

// The first row goes to its other bound, so that the second one would be
// flipped if it had a lower bound.
TEST_F(FlipTest, FlipsOnlyRowsWithTwoBounds) {
  end_.tail(kVariables - 2) = start_.tail(kVariables - 2);
  for (const double sign : {1, -1}) {
    for (const double infinite : {-kInfinity, -1e16}) {
      sign_ = sign;
      lower_[1] = infinite;
      search_.path().Forget();
      EXPECT_EQ(Follow(), 2 + 1) << sign << infinite;
      EXPECT_NEAR(search_.y()[1], -100 * sign, tolerance_);
    }
  }
}

// y_1 + y_12 / 2 goes from 1 to -1, while y_12 stays at 1.
TEST_F(FlipTest, FlipsOnlyRowsOfOneVariable) {
  end_.tail(kVariables - 2) = start_.tail(kVariables - 2);
  C_(1, kVariables - 1) = 0.5;
  EXPECT_EQ(Follow(), 2 + 2);
  EXPECT_NEAR(search_.y()[1], -1.5, tolerance_);
}

// Each y_j depends on the others, so that some flips are wrong. The optimum is
// that of a search without a path.
TEST_F(FlipTest, ArrivesAtTheOptimum) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&](double largest) -> Eigen::VectorXd {
    return Eigen::VectorXd::NullaryExpr(
        kVariables, [&] { return largest * uniform(random); });
  };
  int arrived = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    for (int j = 0; j < kVariables; ++j) coupling_.col(j) = draw(0.25);
    start_ = draw(30);
    end_ = draw(30);
    search_.Begin(At(start_));
    if (!search_.Follow(At(end_))) continue;  // A path may be given up.
    ++arrived;
    Solver cold(kVariables, capacity_);
    Solution expected(kVariables, capacity_);
    ASSERT_EQ(cold.Solve(At(end_), &expected), Status::kOptimal);
    // The condition of the task is below 10.
    EXPECT_NEAR((search_.y() - expected.y).norm(), 0, 10 * tolerance_);
  }
  EXPECT_GT(arrived, 190);
}

// Three rows go to their other bounds. An update would take each of them out of
// the factors and put it back.
TEST_F(FlipTest, KeepsTheFactors) {
  coupling_.setConstant(0.1);
  const Hierarchy hierarchy = At(start_);
  WorkingSetProblem problem(kVariables, capacity_, 2 * kVariables + 1,
                            2 * kVariables);
  int failed_level;
  ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
  problem.Plan(hierarchy, 2);
  ParametricSearch::Sides sides = NoSides(capacity_);
  std::fill_n(sides[0].begin(), 6, Side::kUpper);
  problem.Solve(hierarchy, sides);
  const std::int64_t first = problem.work().multiply_adds;
  std::fill_n(sides[0].begin(), 3, Side::kLower);
  problem.Solve(hierarchy, sides);
  EXPECT_LT(4 * (problem.work().multiply_adds - first), first);
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(problem.y()[j], j < 3 ? -1 : 1, tolerance_);
  }
}

}  // namespace
}  // namespace poise
