// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/active_set_search.h"

#include <gtest/gtest.h>

#include <limits>

#include "poise/hqp/certificate.h"
#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/tolerances.h"
#include "poise/math/rank.h"
#include "poise/tests/util/path_between.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kCertified = Certifier::kCertified;  // Also for costs.

// Least violation of a row with entries in hundredths, unless it is rounding.
constexpr double kViolated = 1e-6;

// Relative tolerance of y. Rounding is multiplied by the square of the
// condition of such rows, which is up to about 1e4.
constexpr double kSameY = 1e-6;

class ActiveSetSearchTest : public testing::TestWithParam<int> {
 protected:
  ActiveSetSearchTest() {
    Cascade cascade(n_, drawn_.capacity);
    EXPECT_EQ(cascade.Solve(hierarchy_, &reference_), Status::kOptimal);
  }
  static HierarchyCase Draw() {
    RandomHierarchyOptions options;
    options.scaled = 0;
    return MakeRandomHierarchy(GetParam(), options);
  }
  // Searches within the budget. Returns the number of levels solved.
  int Search(int max_iterations) {
    WorkingSetProblem problem(n_, drawn_.capacity);
    EXPECT_EQ(problem.Read(hierarchy_, &found_.failed_level), Status::kOptimal);
    side_ = NoSides(drawn_.capacity);
    Budget budget({max_iterations}, &no_clock_);
    const int levels =
        search_.LevelByLevel(hierarchy_, &budget, &problem, &side_);
    iterations_ = budget.iterations();
    found_.y = Eigen::VectorXd::Map(search_.y().data(), n_);
    for (int level = 0; level < num_levels_; ++level) {
      EvaluateLevel(hierarchy_, level, &found_);
    }
    return levels;
  }
  // Expects that the violated rows of the first `levels` levels are in the
  // working set, and that no row of the other levels is.
  void ExpectHeldBack(int levels) const;
  double Tolerance(int level) const {
    return kCertified * CostSize(hierarchy_, level, reference_);
  }

  const HierarchyCase drawn_ = Draw();
  const Hierarchy& hierarchy_ = drawn_.hierarchy;
  const int n_ = hierarchy_.num_variables();
  const int num_levels_ = hierarchy_.num_levels();
  const std::function<double()> no_clock_;
  Solution reference_{n_, drawn_.capacity}, found_{n_, drawn_.capacity};
  ActiveSetSearch search_{n_, drawn_.capacity};
  int iterations_ = 0;
  std::vector<std::vector<Side>> side_;
};

void ActiveSetSearchTest::ExpectHeldBack(int levels) const {
  for (int level = 0; level < num_levels_; ++level) {
    const Eigen::VectorXd value = hierarchy_.C(level) * found_.y;
    for (int i = 0; i < hierarchy_.num_inequalities(level); ++i) {
      const Side side = side_[level][i];
      if (level >= levels) {
        EXPECT_EQ(side, Side::kNone) << level << ", " << i;
      } else if (value[i] > hierarchy_.upper(level)[i] + kViolated) {
        EXPECT_EQ(side, Side::kUpper) << level << ", " << i;
      } else if (value[i] < hierarchy_.lower(level)[i] - kViolated) {
        EXPECT_NE(side, Side::kNone) << level << ", " << i;
      }
    }
  }
}

TEST_P(ActiveSetSearchTest, AgreesWithTheCascade) {
  ASSERT_EQ(Search(10000), num_levels_ + 1);
  for (int level = 0; level < num_levels_; ++level) {
    EXPECT_NEAR(found_.levels[level].cost, reference_.levels[level].cost,
                Tolerance(level))
        << level;
  }
  // The optimum of minimum norm is unique.
  EXPECT_LE((found_.y - reference_.y).norm(),
            kSameY * (1 + reference_.y.norm()));
}

// If the budget is spent, only the lowest levels are not optimal.
TEST_P(ActiveSetSearchTest, KeepsSolvedLevelsWhenTheBudgetEnds) {
  ASSERT_EQ(Search(10000), num_levels_ + 1);
  const int needed = iterations_;
  for (int budget = 0; budget < needed; ++budget) {
    const int levels = Search(budget);
    ASSERT_GE(levels, 0);
    ASSERT_LE(levels, num_levels_);
    EXPECT_EQ(iterations_, budget);
    ExpectHeldBack(levels);
    for (int level = 0; level < levels; ++level) {
      EXPECT_NEAR(found_.levels[level].cost, reference_.levels[level].cost,
                  Tolerance(level))
          << level << " of " << levels;
    }
  }
}

// Starts from different working sets, and from the y of the last search.
TEST_P(ActiveSetSearchTest, AgreesWithTheCascadeAllAtOnce) {
  for (int start = 0; start < 4; ++start) {
    SCOPED_TRACE(start);
    WorkingSetProblem problem(n_, drawn_.capacity);
    ASSERT_EQ(problem.Read(hierarchy_, &found_.failed_level), Status::kOptimal);
    std::vector<std::vector<Side>> side = NoSides(drawn_.capacity);
    for (int level = 0; level < num_levels_; ++level) {
      for (int i = 0; i < hierarchy_.num_inequalities(level); ++i) {
        const double lower = hierarchy_.lower(level)[i];
        const double upper = hierarchy_.upper(level)[i];
        if (lower == upper || ((i + start) % 3 == 1 && !std::isinf(upper))) {
          side[level][i] = Side::kUpper;
        } else if ((i + start) % 3 == 2 && !std::isinf(lower)) {
          side[level][i] = Side::kLower;
        }
        if (start == 0 && lower != upper) side[level][i] = Side::kNone;
      }
    }
    Budget budget({10000}, &no_clock_);
    ASSERT_TRUE(search_.AllAtOnce(hierarchy_, 10000, &budget, &problem, &side));
    found_.y = Eigen::VectorXd::Map(search_.y().data(), n_);
    for (int level = 0; level < num_levels_; ++level) {
      EvaluateLevel(hierarchy_, level, &found_);
      EXPECT_NEAR(found_.levels[level].cost, reference_.levels[level].cost,
                  Tolerance(level))
          << level;
    }
    EXPECT_LE((found_.y - reference_.y).norm(),
              kSameY * (1 + reference_.y.norm()));
    // A second search, from the optimum, takes one iteration.
    const int needed = budget.iterations();
    ASSERT_TRUE(search_.AllAtOnce(hierarchy_, 10000, &budget, &problem, &side));
    EXPECT_EQ(budget.iterations(), needed + 1);
  }
}

// Later steps correct a wrong step, so a wrong step shows only in the number of
// iterations.
TEST(ActiveSetSearch, NeedsAtMostTheRecordedNumberOfIterations) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  const std::function<double()> no_clock;
  Budget at_once({100000}, &no_clock), by_level({100000}, &no_clock);
  for (int seed = 0; seed < 300; ++seed) {
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    WorkingSetProblem problem(n, drawn.capacity);
    int failed;
    ASSERT_EQ(problem.Read(drawn.hierarchy, &failed), Status::kOptimal);
    std::vector<std::vector<Side>> side = NoSides(drawn.capacity);
    ActiveSetSearch search(n, drawn.capacity);
    ASSERT_EQ(search.LevelByLevel(drawn.hierarchy, &by_level, &problem, &side),
              drawn.hierarchy.num_levels() + 1);
    // Starts from that y. The working set has only the rows with equal bounds.
    side = NoSides(drawn.capacity);
    for (int level = 0; level < drawn.hierarchy.num_levels(); ++level) {
      for (int i = 0; i < drawn.hierarchy.num_inequalities(level); ++i) {
        if (drawn.hierarchy.lower(level)[i] ==
            drawn.hierarchy.upper(level)[i]) {
          side[level][i] = Side::kUpper;
        }
      }
    }
    ASSERT_TRUE(
        search.AllAtOnce(drawn.hierarchy, 100000, &at_once, &problem, &side));
  }
  // Rounding may change these numbers by a few.
  EXPECT_LE(by_level.iterations(), 1680);
  EXPECT_LE(at_once.iterations(), 979);
}

// The row -1 <= y <= 1 is active at its upper bound, and the target is -3. The
// lower bound blocks the step and replaces the upper bound.
TEST(ActiveSetSearch, ChangesTheSideOfARow) {
  const std::vector<LevelCapacity> capacity = {{0, 1}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock row = hierarchy.AddInequalities(0, 1);
  row.C(0, 0) = 1;
  row.lower[0] = -1;
  row.upper[0] = 1;
  EqualityBlock aim = hierarchy.AddEqualities(1, 1);
  aim.B(0, 0) = 1;
  aim.b[0] = 3;
  WorkingSetProblem problem(1, capacity);
  int failed;
  ASSERT_EQ(problem.Read(hierarchy, &failed), Status::kOptimal);
  std::vector<std::vector<Side>> side = {{Side::kUpper}, {}};
  const std::function<double()> no_clock;
  Budget budget({100}, &no_clock);
  ActiveSetSearch search(1, capacity);
  ASSERT_TRUE(search.AllAtOnce(hierarchy, 100, &budget, &problem, &side));
  EXPECT_EQ(side[0][0], Side::kLower);
  EXPECT_EQ(search.y()[0], -1);
  // The iterations: solved at 1, where the row is removed; blocked on the way
  // to -3; solved at -1.
  EXPECT_EQ(budget.iterations(), 3);
  for (int too_few = 0; too_few < 3; ++too_few) {
    Budget short_of_it({too_few}, &no_clock);
    side = {{Side::kUpper}, {}};
    EXPECT_FALSE(ActiveSetSearch(1, capacity)
                     .AllAtOnce(hierarchy, 100, &short_of_it, &problem, &side));
    Budget ample({100}, &no_clock);
    side = {{Side::kUpper}, {}};
    EXPECT_FALSE(ActiveSetSearch(1, capacity)
                     .AllAtOnce(hierarchy, too_few, &ample, &problem, &side));
  }
  search.Forget();
  EXPECT_EQ(search.y()[0], 0);
}

// Adds rows and targets one by one, and searches in either way.
class ActiveSetSearchByHandTest : public testing::Test {
 protected:
  explicit ActiveSetSearchByHandTest(int n = 3) : hierarchy_(n, capacity_) {}

  void AddRow(int level, const std::vector<double>& row, double lower,
              double upper) {
    InequalityBlock block = hierarchy_.AddInequalities(level, 1);
    for (size_t j = 0; j < row.size(); ++j) block.C(0, j) = row[j];
    block.lower[0] = lower;
    block.upper[0] = upper;
  }
  void AddTarget(int level, int variable, double target) {
    EqualityBlock block = hierarchy_.AddEqualities(level, 1);
    block.B(0, variable) = 1;
    block.b[0] = -target;
  }
  // Adds the rows y_j >= 1, which start active, and the target (2, 3, 4) on
  // `level`.
  void HoldAtOne(int level) {
    for (int j = 0; j < 3; ++j) {
      std::vector<double> row(3);
      row[j] = 1;
      AddRow(0, row, 1, INFINITY);
      AddTarget(level, j, 2 + j);
    }
    begin_ = Side::kLower;
  }
  // Returns the number of solved levels.
  int ByLevel(int max_iterations = 100) {
    return Search(max_iterations, [&](ActiveSetSearch* search, Budget* budget,
                                      WorkingSetProblem* problem) {
      return search->LevelByLevel(hierarchy_, budget, problem, &side_);
    });
  }
  bool AtOnce(int max_iterations = 100) {
    return Search(max_iterations, [&](ActiveSetSearch* search, Budget* budget,
                                      WorkingSetProblem* problem) {
      return search->AllAtOnce(hierarchy_, 100, budget, problem, &side_);
    });
  }
  Side side(int level, int i) const { return side_[level][i]; }

  const std::vector<LevelCapacity> capacity_{{3, 50}, {3, 3}, {3, 0}};
  Hierarchy hierarchy_;
  Side begin_ = Side::kNone;  // Initial side of the rows of level 0.
  int iterations_;
  Eigen::VectorXd y_;

 private:
  template <typename Function>
  int Search(int max_iterations, const Function& function);

  std::vector<std::vector<Side>> side_;
};

template <typename Function>
int ActiveSetSearchByHandTest::Search(int max_iterations,
                                      const Function& function) {
  const int n = hierarchy_.num_variables();
  WorkingSetProblem problem(n, capacity_);
  int failed_level;
  EXPECT_EQ(problem.Read(hierarchy_, &failed_level), Status::kOptimal);
  const std::function<double()> no_clock;
  Budget budget({max_iterations}, &no_clock);
  ActiveSetSearch search(n, capacity_);
  side_ = NoSides(capacity_);
  for (int i = 0; i < hierarchy_.num_inequalities(0); ++i) {
    side_[0][i] = begin_;
  }
  const int result = function(&search, &budget, &problem);
  iterations_ = budget.iterations();
  y_ = Eigen::VectorXd::Map(search.y().data(), n);
  return result;
}

// On the way to (2, 5) a row blocks at half of the step.
TEST_F(ActiveSetSearchByHandTest, StopsAtABlockingConstraint) {
  AddRow(0, {4, 0, 0}, -INFINITY, 4);
  AddTarget(1, 0, 2);
  AddTarget(1, 1, 5);
  // Five iterations: level 0, without a step; level 1, up to the blocking
  // constraint; the optimum of level 1; level 2, which is empty; the norm of y.
  EXPECT_EQ(ByLevel(0), 0);
  EXPECT_EQ(y_, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(ByLevel(2), 1);
  EXPECT_EQ(y_, Eigen::Vector3d(1, 2.5, 0));
  EXPECT_EQ(side(0, 0), Side::kNone);  // The level is not solved.
  EXPECT_EQ(ByLevel(), 4);
  EXPECT_EQ(y_, Eigen::Vector3d(1, 5, 0));
  EXPECT_EQ(side(0, 0), Side::kUpper);
  EXPECT_EQ(iterations_, 5);
}

// Rows added on a level that is not solved are removed again.
TEST_F(ActiveSetSearchByHandTest, RestoresTheWorkingSetOfTheLastSolvedLevel) {
  AddRow(0, {1, 0, 0}, 1, INFINITY);
  EXPECT_EQ(ByLevel(0), 0);
  EXPECT_EQ(side(0, 0), Side::kNone);
  EXPECT_EQ(ByLevel(1), 1);
  EXPECT_EQ(side(0, 0), Side::kLower);
}

// Two rows block at the same point. Once the steeper one is added, the other
// one no longer blocks.
TEST_F(ActiveSetSearchByHandTest, AddsTheSteepestOfTwoBlockingConstraints) {
  for (const bool first : {false, true}) {
    for (const double scale : {0.1, 1.0, 10.0}) {
      hierarchy_.Clear(3);
      if (first) AddRow(0, {1, 0, 0}, -INFINITY, 1);
      AddRow(0, {scale, scale, 0}, -INFINITY, scale);
      if (!first) AddRow(0, {1, 0, 0}, -INFINITY, 1);
      AddTarget(1, 0, 2);
      ASSERT_EQ(ByLevel(), 4);
      EXPECT_EQ(side(0, first ? 0 : 1), Side::kUpper) << scale;
      EXPECT_EQ(side(0, first ? 1 : 0), Side::kNone) << scale;
      EXPECT_EQ(y_, Eigen::Vector3d(1, 0, 0));
    }
  }
}

// A bound that y touches at the start or at the end does not block.
TEST_F(ActiveSetSearchByHandTest, DoesNotAddRowsThatTheStepOnlyTouches) {
  for (const double sign : {-1.0, 1.0}) {
    hierarchy_.Clear(3);
    AddRow(0, {sign, 0, 0}, -INFINITY, 0);  // At the start,
    AddRow(0, {0, sign, 0}, 0, INFINITY);
    AddRow(0, {0, 0, 1}, -1, 1);  // and at the end.
    AddTarget(1, 0, -sign);
    AddTarget(1, 1, sign);
    AddTarget(1, 2, sign);
    ASSERT_EQ(ByLevel(), 4);
    EXPECT_EQ(y_, Eigen::Vector3d(-sign, sign, sign));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(side(0, i), Side::kNone) << i;
    EXPECT_EQ(iterations_, 4);
  }
}

// 2 y0 <= 2 with y1 = 10, and a target beyond the bound, in any unit. y meets
// the row to the tolerance of the certificate. If the violation is rounding of
// a hundred terms, one iteration suffices.
TEST_F(ActiveSetSearchByHandTest, MeetsARowForAnyInitialViolation) {
  const double size = 2 * 10 + 2;
  const double rounding = 100 * std::numeric_limits<double>::epsilon() * size;
  for (const double unit : {1.0, 0x1p-40}) {
    for (const double violation : {0., 1e-16, rounding, 1e-7, 1e-5, 1e-2, 1.}) {
      for (const double sign : {-1.0, 1.0}) {
        SCOPED_TRACE(testing::Message() << violation << ", " << sign);
        hierarchy_.Clear(3);
        AddRow(0, {2 * sign, 0, 0}, -INFINITY, 2 * unit);
        AddTarget(1, 0, sign * unit * (1 + violation / 2));
        AddTarget(1, 1, 10 * unit);
        ASSERT_TRUE(AtOnce());
        EXPECT_LE(iterations_, violation <= rounding ? 1 : 3);
        EXPECT_LE(2 * sign * y_[0], unit * (2 + tolerances::kAtBound * size));
        EXPECT_GE(sign * y_[0], unit * (1 - Rounding(1, 2)));
        EXPECT_NEAR(y_[1], 10 * unit, unit * Rounding(10, 2));
      }
    }
  }
}

// y0 + y2 <= 1, where y0 = 1 is fixed and y2 has a positive target. y1 becomes
// 1e8 before the step of y2 or in the same step. The row is met to
// kRankTolerance of 1e8. A step that is rounding of 1e8 does not add the row to
// the working set.
TEST_F(ActiveSetSearchByHandTest, IgnoresRoundingAsABlockingConstraint) {
  constexpr double kLarge = 1e8;
  const double rounding = 100 * std::numeric_limits<double>::epsilon() * kLarge;
  for (const bool moves : {false, true}) {
    for (const double target : {0., rounding, 1e-2, 0.5, 1e2, 1e6}) {
      SCOPED_TRACE(testing::Message() << moves << ", " << target);
      hierarchy_.Clear(3);
      AddRow(0, {1, 0, 1}, -INFINITY, 1);
      AddTarget(0, 0, 1);
      AddTarget(moves ? 1 : 0, 1, kLarge);
      AddTarget(1, 2, target);
      ASSERT_EQ(ByLevel(), 4);
      EXPECT_LE(iterations_, target <= rounding ? 4 : 5);
      EXPECT_NEAR(y_[0], 1, Rounding(1, 3));
      EXPECT_LE(y_[0] + y_[2] - 1, 3 * kRankTolerance * kLarge);
      EXPECT_GE(y_[2], -Rounding(1, 3));
    }
  }
}

// y0 >= 1, and on the last level y1 = 5, which violates y1 <= 2. y1 moves only
// after the leading levels are optimal.
TEST_F(ActiveSetSearchByHandTest, SolvesDiagonalLevelsAfterTheLeadingOnes) {
  AddRow(0, {1, 0, 0}, 1, INFINITY);
  AddRow(0, {0, 1, 0}, -INFINITY, 2);
  AddTarget(2, 1, 5);
  EXPECT_FALSE(AtOnce(2));
  EXPECT_EQ(y_, Eigen::Vector3d(1, 2, 0));
  EXPECT_TRUE(AtOnce(3));
  EXPECT_EQ(y_, Eigen::Vector3d(1, 2, 0));
}

// Rows whose multiplier comes from a diagonal level are removed together.
TEST_F(ActiveSetSearchByHandTest, RemovesRowsTogetherForADiagonalLevel) {
  HoldAtOne(2);
  ASSERT_TRUE(AtOnce());
  EXPECT_EQ(y_, Eigen::Vector3d(2, 3, 4));
  // One iteration with the rows, and one without.
  EXPECT_EQ(iterations_, 2);
}

// Rows whose multiplier comes from a leading level are removed one by one:
// removing several at once costs more steps than it saves.
TEST_F(ActiveSetSearchByHandTest, RemovesRowsOneByOneForALeadingLevel) {
  HoldAtOne(1);
  AddRow(1, {1, 1, 1}, -INFINITY,
         100);  // With an inequality, the level is not diagonal.
  ASSERT_TRUE(AtOnce());
  EXPECT_EQ(y_, Eigen::Vector3d(2, 3, 4));
  EXPECT_EQ(iterations_, 4);
}

// Level 0 has as many rows as the capacity allows.
TEST_F(ActiveSetSearchByHandTest, HasRoomForManyRows) {
  for (int i = 0; i < 50; ++i) {
    AddRow(0, {1, 0, 0}, i == 30 ? 2 : -INFINITY, i == 49 ? 3 : 4 + i);
  }
  AddTarget(1, 0, 5);
  AddTarget(1, 1, 1);
  ASSERT_TRUE(AtOnce());
  EXPECT_EQ(y_, Eigen::Vector3d(3, 1, 0));
  ASSERT_EQ(ByLevel(), 4);
  EXPECT_EQ(y_, Eigen::Vector3d(3, 1, 0));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ActiveSetSearchTest, testing::Range(0, 200));

// Level 0 wants y0 <= 1 and y0 >= 3, which contradict each other, y1 >= 2 and
// y1 <= 5. Level 1 wants y = (2, 0). So y0 = 2 violates both of its rows, and
// y1 = 2 is at its lower bound.
TEST(ActiveSetSearch, StopRemovesOnlyRowsInsideTheirBound) {
  const std::vector<LevelCapacity> capacity{{0, 4}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  hierarchy.Clear(2);
  InequalityBlock rows = hierarchy.AddInequalities(0, 4);
  rows.C << 1, 0, 1, 0, 0, 1, 0, 1;
  rows.upper[0] = 1;
  rows.lower[1] = 3;
  rows.lower[2] = 2;
  rows.upper[3] = 5;
  EqualityBlock target = hierarchy.AddEqualities(1, 2);
  target.B.setIdentity();
  target.b << -2, 0;
  WorkingSetProblem problem(2, capacity);
  int failed_level;
  ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
  ActiveSetSearch search(2, capacity);
  std::vector<std::vector<Side>> side = NoSides(capacity);
  const std::function<double()> no_clock;
  Budget budget({100}, &no_clock);
  ASSERT_TRUE(search.AllAtOnce(hierarchy, 100, &budget, &problem, &side));
  const std::vector<Side> needed = {Side::kUpper, Side::kLower, Side::kLower,
                                    Side::kNone};
  EXPECT_EQ(side[0], needed);
  side[0][3] = Side::kUpper;
  search.Stop(hierarchy, problem, &side);
  EXPECT_EQ(side[0], needed);
}

}  // namespace
}  // namespace poise
