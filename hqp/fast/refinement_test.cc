// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests of WorkingSetProblem::Refine().
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "poise/hqp/fast/tolerances.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Refinement of a row ends at this part of its terms.
using tolerances::kRefined;

// Hierarchies of rows with two or more variables, which can be met, and a last
// level with targets for some variables.
class RefinementTest : public testing::Test {
 protected:
  struct Met {
    Eigen::RowVectorXd row;
    double target;
    int level = 0;
  };
  struct Target {
    int variable;
    double target;
  };
  // Solves and refines, from the solution or from another y.
  Eigen::VectorXd Refine(const std::vector<Met>& rows,
                         const std::vector<Target>& targets,
                         const std::vector<double>* other = nullptr);
  static Eigen::RowVectorXd Row(const std::vector<double>& entries) {
    return Eigen::RowVectorXd::Map(entries.data(), entries.size());
  }
  static void ExpectMet(const Met& met, const Eigen::VectorXd& y) {
    const double size = met.row.cwiseAbs() * y.cwiseAbs();
    EXPECT_NEAR(met.row * y, met.target,
                kRefined * (size + std::abs(met.target)))
        << met.row;
  }

  std::vector<double> residual_;    // By row, not scaled to unit length.
  Eigen::VectorXd solved_y_;        // Before refinement.
  std::int64_t multiply_adds_ = 0;  // The refinement has taken so many.
};

Eigen::VectorXd RefinementTest::Refine(const std::vector<Met>& rows,
                                       const std::vector<Target>& targets,
                                       const std::vector<double>* other) {
  const auto n = static_cast<int>(rows[0].row.size());
  // The capacity is larger than needed.
  const std::vector<LevelCapacity> capacity{{8, 0}, {8, 0}, {8, 0}, {8, 0}};
  Hierarchy hierarchy(n, capacity);
  for (const Met& met : rows) {
    EqualityBlock block = hierarchy.AddEqualities(met.level, 1);
    block.B = met.row;
    block.b[0] = -met.target;
  }
  for (const Target& desired : targets) {
    EqualityBlock block = hierarchy.AddEqualities(3, 1);
    block.B(0, desired.variable) = 1;
    block.b[0] = -desired.target;
  }
  WorkingSetProblem problem(n, capacity);
  int failed_level;
  EXPECT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
  problem.Plan(hierarchy, 4);
  EXPECT_GE(problem.num_leading(), 1);
  problem.Solve(hierarchy, {{}, {}, {}, {}});
  solved_y_ = Eigen::VectorXd::Map(problem.y().data(), n);
  const std::int64_t before = problem.work().multiply_adds;
  if (other != nullptr) {
    problem.RefineFrom(hierarchy, *other);
  } else {
    problem.Refine(hierarchy);
  }
  multiply_adds_ = problem.work().multiply_adds - before;
  residual_.clear();
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    residual_.push_back(problem.leading().residual(a) * problem.row(a).norm);
  }
  return Eigen::VectorXd::Map(problem.y().data(), n);
}

// y0 + y1 = L, and two rows of y1 and y2 with small targets. Before refinement,
// rounding of L is larger than y1 and y2. Each pass recovers 15 digits. The
// small target of y3 is kept.
TEST_F(RefinementTest, RecoversSmallEntriesBesideLargeOnes) {
  for (const double large : {1e10, 1e20, 1e36, 1e90}) {
    std::vector<Met> rows{{Row({1, 1, 0, 0, 0, 0}), large},
                          {Row({0, 1, 1, 0, 0, 0}), 3e-6},
                          {Row({0, 1, -1, 0, 0, 0}), 1e-6}};
    // Two rows conflict. Refinement keeps their residual.
    const Met torn[] = {{Row({0, 1, 0, 0, 1, 1}), 1, 1},
                        {Row({0, 1, 0, 0, 1, 1}), 3, 1}};
    std::vector<int> order{0, 1, 2};
    do {
      SCOPED_TRACE(testing::Message() << large << ": " << order[0] << order[1]);
      const Eigen::VectorXd y = Refine(
          {rows[order[0]], rows[order[1]], rows[order[2]], torn[0], torn[1]},
          {{3, 0.7}});
      for (const Met& met : rows) ExpectMet(met, y);
      EXPECT_EQ(y[3], 0.7);
      EXPECT_NEAR(residual_[3], 1, Rounding(3, 3));
      EXPECT_NEAR(residual_[4], -1, Rounding(3, 3));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

// The row of level 1 conflicts with level 0. Its residual has only six digits
// before refinement.
TEST_F(RefinementTest, RecoversTheResidualOfALevel) {
  Refine({{Row({1, 1, 0}), 1e10},
          {Row({0, 1, 1}), 3e-6},
          {Row({0, 1, -1}), 1e-6},
          {Row({0, 1, 1}), 1, 1}},
         {});
  EXPECT_NEAR(residual_[3], 3e-6 - 1, Rounding(1, 3));
}

// Two rows of y1 and y2 have the target zero, so all their terms are rounding.
// Such rows cannot be met relative to their own terms. Entries of y that are
// rounding are then set to zero: those far below 1e-18 of the largest entry,
// before or after refinement, unless they are at their target.
TEST_F(RefinementTest, SetsRoundingEntriesToZero) {
  const auto refine = [this](double large, double desired,
                             const std::vector<double>& other) {
    return Refine({{Row({1, 1, 0, 0}), large},
                   {Row({0, 1, 2, 0}), 0},
                   {Row({0, 3, -1, 0}), 0}},
                  {{3, desired}}, other.empty() ? nullptr : &other);
  };
  const Eigen::VectorXd y = refine(1e18, 0.7, {});
  EXPECT_EQ(y[0], 1e18);
  EXPECT_EQ(y.tail(3), Eigen::Vector3d(0, 0, 0.7));
  EXPECT_EQ(refine(-1e18, -0.7, {})[3], -0.7);
  for (const double large : {1e18, -1e18}) {
    const double unit = 1e-18 * std::abs(large);
    for (const double sign : {1, -1}) {
      for (const double part : {1e-30, 1e-6, 1e-3}) {
        const double nothing = sign * part * unit;
        EXPECT_EQ(refine(1, 0, {large, 0, 0, nothing})[3], 0);
        // Repeats this with the first variable.
        const std::vector<double> turned{nothing, 0, 0, large};
        EXPECT_EQ(Refine({{Row({0, 0, 1, 1}), 1},
                          {Row({0, 2, 1, 0}), 0},
                          {Row({0, -1, 3, 0}), 0}},
                         {{0, 0}}, &turned)[0],
                  0);
        EXPECT_EQ(refine(large, 0, {1, 0, 0, nothing})[3], 0);
        // The target is a thousand times larger, so the entry is not at its
        // target.
        EXPECT_EQ(refine(large, 1e3 * nothing, {1, 0, 0, nothing})[3], 0);
      }
      for (const double part : {1e2, 1e6, 1e12}) {
        const double something = sign * part * unit;
        EXPECT_EQ(refine(1, 0, {large, 0, 0, something})[3], something);
        EXPECT_EQ(refine(large, 0, {1, 0, 0, something})[3], something);
      }
    }
  }
}

// Rows with the target zero take one more correction at most than rows with
// other targets: after it, the rounding is far below 1e-18 of the largest
// entry.
TEST_F(RefinementTest, StopsWhereRoundingKeepsRowsFromZero) {
  const auto refine = [this](double target) {
    return Refine({{Row({1, 0.3, 0.7}), 300},
                   {Row({0, 0.6, 0.35}), target},
                   {Row({0, 0.15, -0.9}), target}},
                  {});
  };
  EXPECT_EQ(refine(0).tail(2), Eigen::Vector2d::Zero());
  EXPECT_NE(solved_y_.tail(2), Eigen::Vector2d::Zero());
  const std::int64_t to_zero = multiply_adds_;
  refine(1);
  EXPECT_GT(multiply_adds_, 0);
  EXPECT_LE(to_zero, 2 * multiply_adds_);
}

// Three rows meet at y0 = 0, in any order. Rounding of y0 would violate the row
// y0 = 0 by 100 % of its terms.
TEST_F(RefinementTest, SetsRoundingToZeroWhereThreeRowsMeet) {
  std::vector<Met> rows{
      {Row({1, 0}), 0}, {Row({4, 5}), -5}, {Row({-2, 5}), -5}};
  for (int turn = 0; turn < 3; ++turn) {
    const Eigen::VectorXd y = Refine(rows, {});
    EXPECT_EQ(y[0], 0) << turn;
    EXPECT_NEAR(y[1], -1, kRefined) << turn;
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
}

// The residual of conflicting rows is not rounding, so small entries are kept.
TEST_F(RefinementTest, KeepsSmallEntriesBesideConflictingRows) {
  const std::vector<double> other{1e18, 1e18, 0.7};
  const Eigen::VectorXd y = Refine(
      {{Row({1, 1, 0}), 1e18}, {Row({1, 1, 0}), 3e18}}, {{2, 0}}, &other);
  EXPECT_NEAR(residual_[0], 1e18, Rounding(3e18, 2));
  EXPECT_EQ(y[2], 0.7);
}

// Entries that are rounding become zero. Small entries that another level needs
// are kept.
TEST_F(RefinementTest, KeepsSmallEntriesThatALevelNeeds) {
  for (const int needs : {0, 1}) {
    for (const bool first : {false, true}) {
      SCOPED_TRACE(testing::Message() << needs << first);
      std::vector<Met> rows{{Row({1, 1, 0, 0, 0, 0}), 1e20, 1 - needs},
                            {Row({0, 1, 2, 0, 0, 0}), 0, 1 - needs},
                            {Row({0, 3, -1, 0, 0, 0}), 0, 1 - needs}};
      const Met sum{Row({0, 0, 0, 1, 1, 0}), 3e-3, needs};
      const Met difference{Row({0, 0, 0, 1, -1, 0}), 1e-3, needs};
      rows.insert(first ? rows.begin() : rows.end(), {sum, difference});
      const Eigen::VectorXd y = Refine(rows, {{5, 0.7}});
      ExpectMet(sum, y);
      ExpectMet(difference, y);
      EXPECT_EQ(y.segment(1, 2), Eigen::Vector2d::Zero());
      EXPECT_EQ(y[5], 0.7);
    }
  }
}

// y4 = 0.5 is set to zero: relative to its terms, the residual of level 2
// remains smaller than that of the rows of rounding. If all rows are met, small
// entries are kept.
TEST_F(RefinementTest, ComparesTheResidualOfALevelWithItsTerms) {
  const Met large{Row({1, 1, 0, 0, 0, 0}), 1e18};
  const Eigen::VectorXd y = Refine({large,
                                    {Row({0, 1, 5, 0, 0, 0}), 0, 1},
                                    {Row({0, 3, -1, 0, 0, 0}), 0, 1},
                                    {Row({0, 0, 0, 1, 1, 0}), 5.5, 2},
                                    {Row({0, 0, 0, 1, 0, 1}), 10, 2},
                                    {Row({0, 0, 0, 1, 0, -1}), 0, 2}},
                                   {});
  EXPECT_NEAR(y[3], 5, kRefined * 10);
  EXPECT_EQ(y[4], 0);  // Instead of 0.5.
  EXPECT_NEAR(y[5], 5, kRefined * 10);
  const Eigen::VectorXd met = Refine({large,
                                      {Row({1, -1, 0, 0, 0, 0}), 1e17, 1},
                                      {Row({1, -1, 0, 0, 0, 0}), 3e17, 1}},
                                     {{3, 0.7}});
  EXPECT_EQ(met[3], 0.7);
}

}  // namespace
}  // namespace poise
