// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/active_set_search.h"

#include <gtest/gtest.h>

#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kCertified = 1e-9;  // What Solver promises of costs.

// Of rows of numbers in hundredths: far above rounding, and no less is violated.
constexpr double kViolated = 1e-6;

// Of y, relative: rounding by way of the square of the worst condition of such
// rows, about 1e4.
constexpr double kSameY = 1e-6;

std::vector<std::vector<Side>> NoSides(
    const std::vector<LevelCapacity>& capacity) {
  std::vector<std::vector<Side>> side;
  for (const LevelCapacity& level : capacity) {
    side.emplace_back(level.inequalities, Side::kNone);
  }
  return side;
}

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
  // As many levels as the budget pays for, and what they cost.
  int Search(int max_iterations) {
    WorkingSetProblem problem(n_, drawn_.capacity);
    EXPECT_EQ(problem.Read(hierarchy_, &found_.failed_level), Status::kOptimal);
    side_ = NoSides(drawn_.capacity);
    Budget budget(max_iterations, 0, &no_clock_);
    const int levels =
        search_.LevelByLevel(hierarchy_, &budget, &problem, &side_);
    iterations_ = budget.iterations();
    found_.y = Eigen::VectorXd::Map(search_.y().data(), n_);
    for (int level = 0; level < num_levels_; ++level) {
      EvaluateLevel(hierarchy_, level, &found_);
    }
    return levels;
  }
  // Violated rows of the first `levels` levels are in the working set; no row of
  // another level is.
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
  // The smallest of all optima, which is one point.
  EXPECT_LE((found_.y - reference_.y).norm(),
            kSameY * (1 + reference_.y.norm()));
}

// What the budget leaves unsolved is at the bottom; the levels above hold.
TEST_P(ActiveSetSearchTest, KeepsWhatItHasSolvedWhenItsBudgetEnds) {
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

// From anywhere: any rows active, any y.
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
    Budget budget(10000, 0, &no_clock_);
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
    // Once more: it is there.
    const int needed = budget.iterations();
    ASSERT_TRUE(search_.AllAtOnce(hierarchy_, 10000, &budget, &problem, &side));
    EXPECT_EQ(budget.iterations(), needed + 1);
  }
}

// A wrong step is made up for by later ones, and shows in how many there are.
TEST(ActiveSetSearch, TakesAsManyStepsAsItDid) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  const std::function<double()> no_clock;
  Budget at_once(100000, 0, &no_clock), by_level(100000, 0, &no_clock);
  for (int seed = 0; seed < 300; ++seed) {
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    WorkingSetProblem problem(n, drawn.capacity);
    int failed;
    ASSERT_EQ(problem.Read(drawn.hierarchy, &failed), Status::kOptimal);
    std::vector<std::vector<Side>> side = NoSides(drawn.capacity);
    ActiveSetSearch descent(n, drawn.capacity);
    ASSERT_EQ(descent.LevelByLevel(drawn.hierarchy, &by_level, &problem, &side),
              drawn.hierarchy.num_levels() + 1);
    // From there, with nothing active that need not be.
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
        descent.AllAtOnce(drawn.hierarchy, 100000, &at_once, &problem, &side));
  }
  // A few more or less by rounding.
  EXPECT_LE(by_level.iterations(), 1680);
  EXPECT_LE(at_once.iterations(), 979);
}

// y <= 1 and y >= -1 by one row, from its upper side with an aim at -3: the
// lower side is in the way, and takes its place.
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
  Budget budget(100, 0, &no_clock);
  ActiveSetSearch descent(1, capacity);
  ASSERT_TRUE(descent.AllAtOnce(hierarchy, 100, &budget, &problem, &side));
  EXPECT_EQ(side[0][0], Side::kLower);
  EXPECT_EQ(descent.y()[0], -1);
  // At 1; lets go; towards -3, and stopped; there.
  EXPECT_EQ(budget.iterations(), 3);
  for (int too_few = 0; too_few < 3; ++too_few) {
    Budget short_of_it(too_few, 0, &no_clock);
    side = {{Side::kUpper}, {}};
    EXPECT_FALSE(ActiveSetSearch(1, capacity)
                     .AllAtOnce(hierarchy, 100, &short_of_it, &problem, &side));
    Budget ample(100, 0, &no_clock);
    side = {{Side::kUpper}, {}};
    EXPECT_FALSE(ActiveSetSearch(1, capacity)
                     .AllAtOnce(hierarchy, too_few, &ample, &problem, &side));
  }
  descent.Forget();
  EXPECT_EQ(descent.y()[0], 0);
}

// Rows and wishes to be told one by one, and a search on either way.
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
  void AddWish(int level, int variable, double target) {
    EqualityBlock block = hierarchy_.AddEqualities(level, 1);
    block.B(0, variable) = 1;
    block.b[0] = -target;
  }
  // y = (1, 1, 1), held by three rows, where a level wishes for (2, 3, 4).
  void HoldAtOne(int level) {
    for (int j = 0; j < 3; ++j) {
      std::vector<double> row(3);
      row[j] = 1;
      AddRow(0, row, 1, INFINITY);
      AddWish(level, j, 2 + j);
    }
    begin_ = Side::kLower;
  }
  // Returns the levels that are done.
  int ByLevel(int max_iterations = 100) {
    return Search(max_iterations, [&](ActiveSetSearch* descent, Budget* budget,
                                      WorkingSetProblem* problem) {
      return descent->LevelByLevel(hierarchy_, budget, problem, &side_);
    });
  }
  bool AtOnce(int max_iterations = 100) {
    return Search(max_iterations, [&](ActiveSetSearch* descent, Budget* budget,
                                      WorkingSetProblem* problem) {
      return descent->AllAtOnce(hierarchy_, 100, budget, problem, &side_);
    });
  }
  Side side(int level, int i) const { return side_[level][i]; }

  const std::vector<LevelCapacity> capacity_{{3, 50}, {3, 3}, {3, 0}};
  Hierarchy hierarchy_;
  Side begin_ = Side::kNone;  // Where the rows of level 0 are to begin with.
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
  Budget budget(max_iterations, 0, &no_clock);
  ActiveSetSearch descent(n, capacity_);
  side_ = NoSides(capacity_);
  for (int i = 0; i < hierarchy_.num_inequalities(0); ++i) {
    side_[0][i] = begin_;
  }
  const int result = function(&descent, &budget, &problem);
  iterations_ = budget.iterations();
  y_ = Eigen::VectorXd::Map(descent.y().data(), n);
  return result;
}

// On the way to (2, 5) a row is in the way at half of it.
TEST_F(ActiveSetSearchByHandTest, StopsAtTheRowInItsWay) {
  AddRow(0, {4, 0, 0}, -INFINITY, 4);
  AddWish(1, 0, 2);
  AddWish(1, 1, 5);
  // None; level 0, where nothing is to be done; the way; there; the norm of y.
  EXPECT_EQ(ByLevel(0), 0);
  EXPECT_EQ(y_, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(ByLevel(2), 1);
  EXPECT_EQ(y_, Eigen::Vector3d(1, 2.5, 0));
  EXPECT_EQ(side(0, 0), Side::kNone);  // Which nothing has settled yet.
  EXPECT_EQ(ByLevel(), 4);
  EXPECT_EQ(y_, Eigen::Vector3d(1, 5, 0));
  EXPECT_EQ(side(0, 0), Side::kUpper);
  EXPECT_EQ(iterations_, 5);
}

// What a level began with, and did not end, is no longer active.
TEST_F(ActiveSetSearchByHandTest, UnwindsALevelThatItHasNotDone) {
  AddRow(0, {1, 0, 0}, 1, INFINITY);
  EXPECT_EQ(ByLevel(0), 0);
  EXPECT_EQ(side(0, 0), Side::kNone);
  EXPECT_EQ(ByLevel(1), 1);
  EXPECT_EQ(side(0, 0), Side::kLower);
}

// Of two rows in the way at the same point, the one that the way goes across:
// the other is in the way no more.
TEST_F(ActiveSetSearchByHandTest, TakesTheSteepestOfRowsThatMeet) {
  for (const bool first : {false, true}) {
    for (const double scale : {0.1, 1.0, 10.0}) {
      hierarchy_.Clear(3);
      if (first) AddRow(0, {1, 0, 0}, -INFINITY, 1);
      AddRow(0, {scale, scale, 0}, -INFINITY, scale);
      if (!first) AddRow(0, {1, 0, 0}, -INFINITY, 1);
      AddWish(1, 0, 2);
      ASSERT_EQ(ByLevel(), 4);
      EXPECT_EQ(side(0, first ? 0 : 1), Side::kUpper) << scale;
      EXPECT_EQ(side(0, first ? 1 : 0), Side::kNone) << scale;
      EXPECT_EQ(y_, Eigen::Vector3d(1, 0, 0));
    }
  }
}

// What is touched, at the start or at the end, is not in the way.
TEST_F(ActiveSetSearchByHandTest, LeavesRowsThatItOnlyTouches) {
  for (const double sign : {-1.0, 1.0}) {
    hierarchy_.Clear(3);
    AddRow(0, {sign, 0, 0}, -INFINITY, 0);  // At the start,
    AddRow(0, {0, sign, 0}, 0, INFINITY);
    AddRow(0, {0, 0, 1}, -1, 1);  // and at the end.
    AddWish(1, 0, -sign);
    AddWish(1, 1, sign);
    AddWish(1, 2, sign);
    ASSERT_EQ(ByLevel(), 4);
    EXPECT_EQ(y_, Eigen::Vector3d(-sign, sign, sign));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(side(0, i), Side::kNone) << i;
    EXPECT_EQ(iterations_, 4);
  }
}

// 2 y0 <= 2, with y1 = 10: broken from 1e-11 (2 10 + 2) on, in any unit.
TEST_F(ActiveSetSearchByHandTest, BreaksARowFromAnEdgeOn) {
  for (const double unit : {1.0, 0x1p-40}) {
    for (const double violation : {2.1e-10, 2.3e-10}) {
      for (const double sign : {-1.0, 1.0}) {
        hierarchy_.Clear(3);
        AddRow(0, {2 * sign, 0, 0}, -INFINITY, 2 * unit);
        AddWish(1, 0, sign * unit * (1 + violation / 2));
        AddWish(1, 1, 10 * unit);
        ASSERT_TRUE(AtOnce());
        EXPECT_EQ(iterations_, violation < 2.2e-10 ? 1 : 3);
        EXPECT_EQ(side(0, 0), violation < 2.2e-10 ? Side::kNone : Side::kUpper);
      }
    }
  }
}

// y0 + y2 <= 1 where y0 = 1 is settled, and y2 wants a little: that is in the
// way from 1e-13 (|y| before + |y| after) and 1e-11 of the way on, times a norm
// of 2.
TEST_F(ActiveSetSearchByHandTest, IgnoresRoundingAsABlockingConstraint) {
  for (const bool moves : {false, true}) {
    const double edge = moves ? 2 * (1e-3 + 1e-5) : 2 * 2e-5;
    for (const double share : {0.01, 100.}) {
      hierarchy_.Clear(3);
      AddRow(0, {1, 0, 1}, -INFINITY, 1);
      AddWish(0, 0, 1);
      AddWish(moves ? 1 : 0, 1, 1e8);
      AddWish(1, 2, share * edge);
      ASSERT_EQ(ByLevel(), 4);
      // y0 is 1 but for its rounding, and that is what is left for y2.
      EXPECT_NEAR(y_[2], share < 1 ? share * edge : 0, Rounding(1, 3)) << moves;
    }
  }
}

// y0 >= 1, and in the last level y1 = 5, which breaks y1 <= 2: not before the
// head is at its best does y1 move.
TEST_F(ActiveSetSearchByHandTest, SparesTheTailUntilTheHeadIsAtItsBest) {
  AddRow(0, {1, 0, 0}, 1, INFINITY);
  AddRow(0, {0, 1, 0}, -INFINITY, 2);
  AddWish(2, 1, 5);
  EXPECT_FALSE(AtOnce(2));
  EXPECT_EQ(y_, Eigen::Vector3d(1, 2, 0));
  EXPECT_TRUE(AtOnce(3));
  EXPECT_EQ(y_, Eigen::Vector3d(1, 2, 0));
}

// Where only the tail draws at them, rows leave together.
TEST_F(ActiveSetSearchByHandTest, LetsGoOfRowsForTheTailTogether) {
  HoldAtOne(2);
  ASSERT_TRUE(AtOnce());
  EXPECT_EQ(y_, Eigen::Vector3d(2, 3, 4));
  // Held; the head without them; which is done, and the tail with it.
  EXPECT_EQ(iterations_, 2);
}

// Where a level of the head draws at them, they leave one by one: letting several
// go there costs more steps than it saves.
TEST_F(ActiveSetSearchByHandTest, LetsGoOfRowsForTheHeadOneByOne) {
  HoldAtOne(1);
  AddRow(1, {1, 1, 1}, -INFINITY, 100);  // It has a row: it is no tail.
  ASSERT_TRUE(AtOnce());
  EXPECT_EQ(y_, Eigen::Vector3d(2, 3, 4));
  EXPECT_EQ(iterations_, 4);
}

// As many rows as there is room for.
TEST_F(ActiveSetSearchByHandTest, HasRoomForManyRows) {
  for (int i = 0; i < 50; ++i) {
    AddRow(0, {1, 0, 0}, i == 30 ? 2 : -INFINITY, i == 49 ? 3 : 4 + i);
  }
  AddWish(1, 0, 5);
  AddWish(1, 1, 1);
  ASSERT_TRUE(AtOnce());
  EXPECT_EQ(y_, Eigen::Vector3d(3, 1, 0));
  ASSERT_EQ(ByLevel(), 4);
  EXPECT_EQ(y_, Eigen::Vector3d(3, 1, 0));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ActiveSetSearchTest, testing::Range(0, 200));

}  // namespace
}  // namespace poise
