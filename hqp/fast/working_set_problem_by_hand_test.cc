// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "poise/hqp/fast/working_set_problem.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Two equal levels. Each has the rows 2 y0 - y1 = 3, y1 = 4 with weight 0, 1 <=
// 5 y0 + 7 y1, and y0 - 3 y1 <= 2.
class WorkingSetProblemReadTest : public testing::Test {
 protected:
  WorkingSetProblemReadTest() {
    for (int k = 0; k < 2; ++k) {
      EqualityBlock equalities = hierarchy_.AddEqualities(k, 2);
      equalities.B << 2, -1, 0, 1;
      equalities.b << -3, -4;
      equalities.weight << 1, 0;
      InequalityBlock rows = hierarchy_.AddInequalities(k, 2);
      rows.C << 5, 7, 1, -3;
      rows.lower[0] = 1;
      rows.upper[1] = 2;
      B_[k] = equalities.B.data();
      b_[k] = equalities.b.data();
      weight_[k] = equalities.weight.data();
      C_[k] = rows.C.data();
      lower_[k] = rows.lower.data();
      upper_[k] = rows.upper.data();
    }
  }
  // Expects this status with one number replaced by `value`.
  void ExpectStatus(double* number, double value, Status status, int level) {
    const double good = *number;
    *number = value;
    int failed_level = 5;
    EXPECT_EQ(problem_.Read(hierarchy_, &failed_level), status) << value;
    EXPECT_EQ(failed_level, level) << value;
    *number = good;
  }

  const std::vector<LevelCapacity> capacity_{{2, 2}, {2, 2}};
  Hierarchy hierarchy_{2, capacity_};
  WorkingSetProblem problem_{2, capacity_};
  double *B_[2], *b_[2], *weight_[2], *C_[2], *lower_[2], *upper_[2];
};

TEST_F(WorkingSetProblemReadTest, FindsTheFirstLevelWithABadNumber) {
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 2; ++i) {
      SCOPED_TRACE(testing::Message() << k << ", " << i);
      for (const double bad : {double(NAN), double(INFINITY)}) {
        for (int j = 0; j < 2; ++j) {
          ExpectStatus(B_[k] + 2 * i + j, bad, Status::kNotFinite, k);
          ExpectStatus(C_[k] + 2 * i + j, bad, Status::kNotFinite, k);
        }
        ExpectStatus(b_[k] + i, bad, Status::kNotFinite, k);
        ExpectStatus(weight_[k] + i, bad, Status::kNotFinite, k);
        ExpectStatus(lower_[k] + i, bad, Status::kNotFinite, k);
        ExpectStatus(upper_[k] + i, -bad, Status::kNotFinite, k);
      }
      ExpectStatus(lower_[k] + i, -INFINITY, Status::kOptimal, -1);
      ExpectStatus(upper_[k] + i, INFINITY, Status::kOptimal, -1);
      ExpectStatus(weight_[k] + i, -1e-9, Status::kBadInput, k);
      ExpectStatus(weight_[k] + i, 0, Status::kOptimal, -1);
    }
    ExpectStatus(upper_[k], 1, Status::kOptimal, -1);
    ExpectStatus(upper_[k], 1 - 1e-9, Status::kBadInput, k);
    ExpectStatus(lower_[k] + 1, 2, Status::kOptimal, -1);
    ExpectStatus(lower_[k] + 1, 2 + 1e-9, Status::kBadInput, k);
    EXPECT_EQ(problem_.norm(k, 0), 12);
    EXPECT_EQ(problem_.norm(k, 1), 4);
  }
  // Level by level, kNotFinite comes before kBadInput.
  *weight_[1] = -1;
  *b_[1] = NAN;
  ExpectStatus(b_[1] + 1, 0, Status::kNotFinite, 1);
  *upper_[0] = 0;
  ExpectStatus(b_[1] + 1, 0, Status::kBadInput, 0);
}

// Equalities do not count as active. The counts begin with Read(). The sum is
// that of all solutions.
TEST_F(WorkingSetProblemReadTest, CountsSolutionsAndActiveInequalities) {
  int failed_level;
  for (int twice = 0; twice < 2; ++twice) {
    ASSERT_EQ(problem_.Read(hierarchy_, &failed_level), Status::kOptimal);
    EXPECT_EQ(problem_.work().num_active, 0);
    EXPECT_EQ(problem_.work().sum_active, 0);
    EXPECT_EQ(problem_.work().num_solved, 0);
    EXPECT_EQ(problem_.work().num_partly_solved, 0);
    problem_.Plan(hierarchy_, 2);
    std::vector<std::vector<Side>> side = {{Side::kLower, Side::kNone},
                                           {Side::kLower, Side::kUpper}};
    problem_.SolveLeading(hierarchy_, side);
    EXPECT_EQ(problem_.work().num_active, 3);
    EXPECT_EQ(problem_.work().sum_active, 3);
    side[1] = {Side::kNone, Side::kNone};
    problem_.SolveLeading(hierarchy_, side);
    EXPECT_EQ(problem_.work().num_active, 1);
    EXPECT_EQ(problem_.work().sum_active, 3 + 1);
    problem_.UseLeading(1);
    problem_.SolveLeading(hierarchy_, side);
    EXPECT_EQ(problem_.work().num_active, 1);
    EXPECT_EQ(problem_.work().sum_active, 3 + 1 + 1);
    EXPECT_EQ(problem_.work().num_solved, 2);
    EXPECT_EQ(problem_.work().num_partly_solved, 1);
  }
}

// The row y0 + y1 = 2, as an equality or as an active row. If its squared norm
// times the weight nearly underflows, it counts as a row of zeros, and y is as
// without it. Any longer row is met.
TEST_F(WorkingSetProblemReadTest, IgnoresRowsWhoseSquareUnderflows) {
  int failed_level;
  const auto solve = [&](double length, double root, bool is_equality) {
    const double zero = 0;
    C_[1][0] = C_[1][1] = is_equality ? zero : length / 2;
    *lower_[1] = is_equality ? -1 : length;
    B_[1][0] = B_[1][1] = is_equality ? length / 2 / root : zero;
    *b_[1] = is_equality ? -length / root : zero;
    *weight_[1] = root * root;
    EXPECT_EQ(problem_.Read(hierarchy_, &failed_level), Status::kOptimal);
    problem_.Plan(hierarchy_, 2);
    problem_.Solve(hierarchy_,
                   {{Side::kNone, Side::kNone}, {Side::kLower, Side::kNone}});
    return Eigen::Vector2d(Eigen::Vector2d::Map(problem_.y().data()));
  };
  for (const bool is_equality : {false, true}) {
    for (const double root : {3., 0.5}) {
      for (const double length : {0., 1e-300, 1e-200, 1e-153}) {
        SCOPED_TRACE(testing::Message() << is_equality << root << length);
        const Eigen::Vector2d y = solve(length, root, is_equality);
        // The shortest y of 2 y0 - y1 = 3.
        EXPECT_LE((y - Eigen::Vector2d(1.2, -0.6)).norm(), Rounding(2, 2));
      }
      for (const double length : {1e-147, 1e-100, 1e-9, 1., 1e9, 1e100}) {
        SCOPED_TRACE(testing::Message() << is_equality << root << length);
        const Eigen::Vector2d y = solve(length, root, is_equality);
        EXPECT_LE((y - Eigen::Vector2d(5, 1) / 3).norm(), Rounding(3, 2, 4));
      }
    }
  }
}

TEST(WorkingSetProblem, FindsDiagonalLevelsOfAnyWeight) {
  for (const double weight : {0., 1e-9, 1e9}) {
    const std::vector<LevelCapacity> capacity{{1, 0}, {2, 0}};
    Hierarchy hierarchy(2, capacity);
    hierarchy.AddEqualities(0, 1).B << 1, 1;
    EqualityBlock targets = hierarchy.AddEqualities(1, 2);
    targets.B.setIdentity();
    targets.weight << weight, 1;
    WorkingSetProblem problem(2, capacity);
    int failed_level;
    EXPECT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
    problem.Plan(hierarchy, 2);
    EXPECT_EQ(problem.num_leading(), 1) << weight;
  }
}

// Level 0: y0 <= 1, 2 y1 >= 4 and 3 <= y2 <= 3. Level 1: y0 + y1 = 8. Level 2:
// 3 y2 = 6, and y1 = 0 with weight 5. With all rows of level 0 in the working
// set, y = (1, 2, 3).
class WorkingSetProblemTest : public testing::Test {
 protected:
  WorkingSetProblemTest() {
    InequalityBlock bounds = hierarchy_.AddInequalities(0, 3);
    bounds.C.setIdentity();
    bounds.C(1, 1) = 2;
    bounds.upper << 1, INFINITY, 3;
    bounds.lower << -INFINITY, 4, 3;
    EqualityBlock sum = hierarchy_.AddEqualities(1, 1);
    sum.B << 1, 1, 0;
    sum.b << -8;
    EqualityBlock targets = hierarchy_.AddEqualities(2, 2);
    targets.B << 0, 0, 3, 0, 1, 0;
    targets.b << -6, 0;
    targets.weight << 1, 5;
    int failed_level;
    EXPECT_EQ(problem_.Read(hierarchy_, &failed_level), Status::kOptimal);
    problem_.Plan(hierarchy_, 3);
    problem_.Solve(hierarchy_,
                   {{Side::kUpper, Side::kLower, Side::kUpper}, {}, {}});
    problem_.FindMultipliers(4);
  }

  const std::vector<LevelCapacity> capacity_{{0, 3}, {1, 0}, {2, 0}};
  Hierarchy hierarchy_{3, capacity_};
  WorkingSetProblem problem_{3, capacity_};
};

TEST_F(WorkingSetProblemTest, FindsTheMultipliersOfEachRow) {
  EXPECT_EQ(problem_.num_leading(), 2);
  EXPECT_EQ(problem_.selected(2, 0), 2);
  EXPECT_EQ(problem_.selected(2, 1), 1);
  const double rounding = Rounding(10, 3);
  EXPECT_LE(
      (Eigen::Vector3d::Map(problem_.y().data()) - Eigen::Vector3d(1, 2, 3))
          .norm(),
      rounding);
  // The gradient of the sum is -5 on y0 and on y1. The upper bound of y0 is
  // binding. The lower bound of y1 is not, and its multiplier is negative.
  EXPECT_NEAR(problem_.Multiplier(0, 1, Side::kUpper, 0), 5, rounding);
  EXPECT_NEAR(problem_.Multiplier(1, 1, Side::kLower, 0), -5, rounding);
  EXPECT_EQ(problem_.Multiplier(2, 1, Side::kUpper, 1e-12), 0);
  // The gradient of the targets is 9 on y2 and 10 on y1.
  EXPECT_EQ(problem_.Multiplier(0, 2, Side::kUpper, 1e-12), 0);
  EXPECT_NEAR(problem_.Multiplier(1, 2, Side::kLower, 0), 10, 5 * rounding);
  EXPECT_NEAR(problem_.Multiplier(2, 2, Side::kUpper, 0), -9, 5 * rounding);
  // Level 0, the level of these rows, is met.
  for (int a = 0; a < 3; ++a) {
    EXPECT_EQ(problem_.Multiplier(a, 0, Side::kUpper, 0), 0);
  }
  // The tolerance is relative to the largest term of the multiplier.
  const WorkingSetProblem::Multipliers& of_sum = problem_.multipliers(1);
  EXPECT_TRUE(of_sum.any);
  const double share = std::abs(of_sum.nu[0]) / of_sum.size;
  EXPECT_EQ(problem_.Multiplier(0, 1, Side::kUpper, 2 * share), 0);
  EXPECT_NEAR(problem_.Multiplier(0, 1, Side::kUpper, share / 2), 5, rounding);
}

// The rows y = 1/16, and y = 1/16 + gap with four times the weight. At the
// optimum the residuals are 4/5 and -1/5 of the gap. They are the same if y is
// off by as much as the gap. A residual that is rounding of the terms, 1/16 +
// 1/16, becomes zero.
TEST(WorkingSetProblem, TreatsRoundingResidualAsZero) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {0, 1}};
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  for (const double part : {0., kEps, 100 * kEps, 1e-10, 1e-6, 1e-2}) {
    for (const double sign : {-1, 1}) {
      SCOPED_TRACE(testing::Message() << part << ", " << sign);
      const double gap = sign * part / 8;
      Hierarchy hierarchy(1, capacity);
      EqualityBlock twice = hierarchy.AddEqualities(0, 2);
      twice.B << 1, 1;
      twice.b << -1. / 16, -(1. / 16 + gap);
      twice.weight << 1, 4;
      // Rows of the next level have no effect, whatever their norm.
      InequalityBlock next = hierarchy.AddInequalities(1, 1);
      next.C << 100;
      next.upper << 50;
      WorkingSetProblem problem(1, capacity);
      int failed_level;
      ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
      problem.Plan(hierarchy, 2);
      problem.Solve(hierarchy, {{}, {Side::kUpper}});
      ASSERT_EQ(problem.num_leading(), 2);
      EXPECT_NEAR(problem.y()[0], 1. / 16 + 0.8 * gap, Rounding(0.125, 1));
      const bool is_rounding = part <= 100 * kEps;
      const double rounding = is_rounding ? 0 : Rounding(0.125, 1);
      for (const double off : {0., 0.8 * gap, gap}) {
        problem.SetSolution(hierarchy, {1. / 16 + off});
        EXPECT_NEAR(problem.leading().residual(0), is_rounding ? 0 : 0.8 * gap,
                    rounding);
        EXPECT_NEAR(problem.leading().residual(1), is_rounding ? 0 : -0.2 * gap,
                    rounding);
      }
    }
  }
}

// Level 0: y0 + y1 = 0. Level 1: y0 + y1 = 5 with weight 3. The multiplier is
// the residual, 5, times the weight and the squared norm. At a y with a
// residual of 4, refinement replaces the 5 by 4.
TEST(WorkingSetProblem, RefinesMultipliersByTheRemainingGradient) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}};
  Hierarchy hierarchy(2, capacity);
  EqualityBlock first = hierarchy.AddEqualities(0, 1);
  first.B << 1, 1;
  first.b << 0;
  EqualityBlock second = hierarchy.AddEqualities(1, 1);
  second.B << 1, 1;
  second.b << -5;
  second.weight << 3;
  WorkingSetProblem problem(2, capacity);
  int failed_level;
  ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
  problem.Plan(hierarchy, 2);
  problem.Solve(hierarchy, {{}, {}});
  problem.FindMultipliers(3);
  const double unit = 6 / std::sqrt(2);
  EXPECT_NEAR(problem.multipliers(1).nu[0], 5 * unit, Rounding(5 * unit, 2));
  problem.SetSolution(hierarchy, {1, 0});
  problem.RefineMultipliers(hierarchy);
  EXPECT_NEAR(problem.multipliers(1).nu[0], 4 * unit, Rounding(5 * unit, 2));
  EXPECT_NEAR(problem.multipliers(1).nu[1], -4 * unit, Rounding(5 * unit, 2));
}

// A level without variables is a leading level.
TEST(WorkingSetProblem, HasNoDiagonalLevelWithoutVariables) {
  const std::vector<LevelCapacity> capacity{{0, 0}};
  WorkingSetProblem problem(0, capacity);
  const Hierarchy hierarchy(0, capacity);
  problem.Plan(hierarchy, 1);
  EXPECT_EQ(problem.num_leading(), 1);
}

// The last level has one variable per row: only the row above it needs memory
// in the factorisation.
TEST(WorkingSetProblem, LimitsTheLeadingRows) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  hierarchy.Clear(2);
  hierarchy.AddEqualities(0, 1).B << 1, 1;
  hierarchy.AddEqualities(1, 2).B.setIdentity();
  int failed_level;
  EXPECT_EQ(WorkingSetProblem(2, capacity, 1, 1).Read(hierarchy, &failed_level),
            Status::kOptimal);
  hierarchy.AddInequalities(0, 1).C << 1, 0;
  EXPECT_EQ(WorkingSetProblem(2, capacity, 1, 1).Read(hierarchy, &failed_level),
            Status::kBadInput);
  EXPECT_EQ(WorkingSetProblem(2, capacity, 2, 2).Read(hierarchy, &failed_level),
            Status::kOptimal);
}

// Level 1 is x = 2, x = 8 and x <= 4, with x = y0, and then x = y1. Kept
// projections of the first problem must not enter the second one.
TEST(WorkingSetProblem, ForgetsTheRowsOfAnotherProblem) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {2, 1}};
  WorkingSetProblem problem(2, capacity, 4, 4);
  for (int j = 0; j < 2; ++j) {
    Hierarchy hierarchy(2, capacity);
    hierarchy.AddInequalities(0, 1).C << 1, 1;
    EqualityBlock both = hierarchy.AddEqualities(1, 2);
    both.B.col(j).setOnes();
    both.b << -2, -8;
    InequalityBlock most = hierarchy.AddInequalities(1, 1);
    most.C(0, j) = 1;
    most.upper << 4;
    int failed_level;
    ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
    problem.Plan(hierarchy, 2);
    std::vector<std::vector<Side>> side = {{Side::kNone}, {Side::kNone}};
    for (const Side at : {Side::kNone, Side::kUpper, Side::kNone}) {
      side[1][0] = at;
      problem.Solve(hierarchy, side);
      const double x = at == Side::kNone ? 5 : 14. / 3;
      EXPECT_NEAR(problem.y()[j], x, Rounding(10, 3));
      EXPECT_NEAR(problem.y()[1 - j], 0, Rounding(10, 3));
    }
  }
}

// Level 0 has twelve equalities. Level 1 has a bound of each variable and a row
// that depends on two of them.
class ManyChangesTest : public testing::Test {
 protected:
  static constexpr int kVariables = 40, kEqualities = 12;
  using Sides = std::vector<std::vector<Side>>;

  ManyChangesTest() {
    EqualityBlock equalities = hierarchy_.AddEqualities(0, kEqualities);
    for (int i = 0; i < kEqualities; ++i) {
      for (int j = 0; j < kVariables; ++j)
        equalities.B(i, j) = std::cos(1 + i * (j + 1));
    }
    equalities.b.setConstant(1);
    InequalityBlock rows = hierarchy_.AddInequalities(1, kVariables + 1);
    rows.C.topRows(kVariables).setIdentity();
    rows.C(kVariables, 0) = rows.C(kVariables, 1) = 1;
    rows.upper.setConstant(1);
  }
  // Returns a working set of the first bounds, and of the last row if `last`.
  static Sides First(int bounds, bool last) {
    Sides sides = {{}, std::vector<Side>(kVariables + 1, Side::kNone)};
    std::fill_n(sides[1].begin(), bounds, Side::kUpper);
    if (last) sides[1].back() = Side::kUpper;
    return sides;
  }
  // Solves for `sides`, after `before` if it is given, in `work` multiply-adds.
  // Returns y.
  std::vector<double> Solve(const Sides* before, const Sides& sides,
                            std::int64_t* work) const {
    WorkingSetProblem problem(kVariables, capacity_);
    int failed_level;
    EXPECT_EQ(problem.Read(hierarchy_, &failed_level), Status::kOptimal);
    problem.Plan(hierarchy_, 2);
    if (before != nullptr) problem.Solve(hierarchy_, *before);
    const std::int64_t start = problem.work().multiply_adds;
    problem.Solve(hierarchy_, sides);
    *work = problem.work().multiply_adds - start;
    return problem.y();
  }
  // Expects that the change to `after` takes at most a quarter more work than a
  // solution from the start, for rows that have been found to depend on others,
  // with the same result.
  void ExpectFast(const Sides& before, const Sides& after) const {
    std::int64_t fresh, update;
    const std::vector<double> expected = Solve(nullptr, after, &fresh);
    const std::vector<double> y = Solve(&before, after, &update);
    EXPECT_LE(4 * update, 5 * fresh);
    for (int j = 0; j < kVariables; ++j) {
      EXPECT_NEAR(y[j], expected[j], Rounding(10, kVariables, 1e3));
    }
  }

  const std::vector<LevelCapacity> capacity_{{kEqualities, 0},
                                             {0, kVariables + 1}};
  Hierarchy hierarchy_{kVariables, capacity_};
};

TEST_F(ManyChangesTest, FactorsAgainIfManyRowsFixVariables) {
  ExpectFast(First(2, false), First(26, false));
  ExpectFast(First(26, false), First(2, false));
}

// The last row depends on the first two. The rows of its level are then not
// merged.
TEST_F(ManyChangesTest, FactorsAgainIfManyRowsAreNotMergedAnyMore) {
  ExpectFast(First(26, false), First(26, true));
}

// The factorisation of level 1 is interrupted, again and again a bit later. The
// equalities are met then, and the next solution is as without an interruption.
TEST_F(ManyChangesTest, KeepsTheEqualitiesIfALaterLevelIsInterrupted) {
  const std::function<double()> no_clock;
  const Sides sides = First(20, true);
  std::int64_t needed;
  const std::vector<double> expected = Solve(nullptr, sides, &needed);
  int kept = 0;
  for (int part = 0; part < 10; ++part) {
    WorkingSetProblem problem(kVariables, capacity_);
    int failed_level;
    ASSERT_EQ(problem.Read(hierarchy_, &failed_level), Status::kOptimal);
    problem.Plan(hierarchy_, 2);
    Work work = problem.work();
    work.multiply_adds += part * needed / 10;
    Budget budget({9, ModelledSeconds(work) / Budget::kMost}, &no_clock);
    for (int i = 0; i <= Budget::kAlways; ++i) ASSERT_TRUE(budget.Take({}));
    EXPECT_FALSE(problem.SolveWithin(hierarchy_, sides, &budget));
    EXPECT_TRUE(budget.is_spent());
    ASSERT_LT(problem.leading().num_levels(), 2);
    if (problem.leading().num_levels() == 1) {
      ++kept;
      problem.Approach(std::vector<double>(kVariables, 0));
      const auto y = Eigen::VectorXd::Map(problem.y().data(), kVariables);
      EXPECT_LE((hierarchy_.B(0) * y + hierarchy_.b(0)).norm(),
                Rounding(10, kVariables, 1e3));
    }
    problem.Solve(hierarchy_, sides);
    for (int j = 0; j < kVariables; ++j) {
      EXPECT_NEAR(problem.y()[j], expected[j], Rounding(10, kVariables, 1e3));
    }
  }
  EXPECT_GT(kept, 2);
}

// A few changes take less work than a factorisation.
TEST_F(ManyChangesTest, UpdatesAFewRows) {
  const Sides before = First(10, false), after = First(11, false);
  std::int64_t fresh, update;
  (void)Solve(nullptr, after, &fresh);
  (void)Solve(&before, after, &update);
  EXPECT_LT(2 * update, fresh);
}

}  // namespace
}  // namespace poise
