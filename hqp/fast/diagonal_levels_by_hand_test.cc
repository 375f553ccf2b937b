// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "hqp/fast/diagonal_levels.h"
#include "hqp/fast/lexicographic_factorization.h"
#include "tests/util/count_malloc.h"
#include "tests/util/tolerance.h"

namespace poise {
namespace {

// y1 + y2 = sqrt(2) above y1 = 3, of weight 1, and y2 = 5, of weight 3; y3 free.
class SelectionTailTest : public testing::Test {
 protected:
  SelectionTailTest() {
    head_.AddRow(1, 1);
    head_.row(0)[0] = head_.row(0)[1] = std::sqrt(0.5);
    head_.FactorLevel();
    AddOnce();
  }
  void AddOnce() {
    tail_.AddLevel();
    tail_.Add(0, 1, 3);
    tail_.Add(1, 3, 5);
    tail_.Finish(nullptr);
  }
  RowStack head_{3, 1, 1};
  SelectionTail tail_{3, 2};
  double y_[3];
};

TEST_F(SelectionTailTest, SolvesByHand) {
  tail_.Solve(head_, y_);
  // The weights share out what the sum lacks: 8 - sqrt(2).
  const double lack = 8 - std::sqrt(2);
  EXPECT_NEAR(y_[0], 3 - 0.75 * lack, Rounding(10, 3));
  EXPECT_NEAR(y_[1], 5 - 0.25 * lack, Rounding(10, 3));
  EXPECT_EQ(y_[2], 0);
  double on_head[1], left[3];
  // What is asked for, beside a part of L of 1/2 + 1/6, squared.
  const double asked = std::hypot(std::sqrt(0.5) + 3, std::sqrt(0.5) + 5);
  EXPECT_NEAR(tail_.Dual(0, on_head, left), 1.5 * asked, Rounding(asked, 3));
  EXPECT_NEAR(std::abs(on_head[0]), 0.75 * lack * std::sqrt(2),
              Rounding(20, 3));
  EXPECT_EQ(tail_.Dual(1, on_head, left), 0);
  EXPECT_EQ(tail_.Nullity(0), 1);
  EXPECT_EQ(tail_.Nullity(1), 0);
}

// Beside a light variable a heavy one's rounding does not count.
TEST_F(SelectionTailTest, AGradientIsRelativeToTheLightestThatCanMeetARow) {
  tail_.Clear();
  tail_.AddLevel();
  tail_.Add(0, 1, 3);
  tail_.Add(1, 1e12, 5);
  tail_.Finish(nullptr);
  tail_.Solve(head_, y_);
  double on_head[1], left[3];
  const double asked = std::hypot(std::sqrt(0.5) + 3, std::sqrt(0.5) + 5);
  EXPECT_NEAR(tail_.Dual(0, on_head, left), 2 * asked, 1e-10);  // By 1e-12.
}

// Of each variable's own sum, what is below 1e-13 of weight (|y| + |target|).
TEST_F(SelectionTailTest, DropsRoundingOfAGradient) {
  const double y[3] = {-1, 2, 0}, size[2] = {4e-13, 21e-13};
  for (const double share : {0.9, 1.1}) {
    for (const double sign : {-1, 1}) {
      double sum[3] = {sign * share * size[0], -sign * share * size[1], 1e-30};
      tail_.DropRounding(0, y, sum);
      for (int j = 0; j < 2; ++j) {
        EXPECT_EQ(sum[j] == 0, share < 1) << j;
      }
      EXPECT_EQ(sum[2], 1e-30);  // Of another level.
    }
  }
}

// Of the level's own variables, each.
TEST_F(SelectionTailTest, IsMetWhereEachVariableIsAtItsTarget) {
  const double met[3] = {3, 5, -1}, first[3] = {3, 4, 0},
               second[3] = {-3, 5, 0};
  EXPECT_TRUE(tail_.IsMet(0, met));
  EXPECT_FALSE(tail_.IsMet(0, first));
  EXPECT_FALSE(tail_.IsMet(0, second));
  EXPECT_FALSE(tail_.IsMet(1, met));
  const double other[3] = {0, 0, 0};
  EXPECT_TRUE(tail_.IsMet(1, other));
}

TEST_F(SelectionTailTest, TakesTwoTargetsOfALevelForTheirMean) {
  tail_.Clear();
  EXPECT_EQ(tail_.num_levels(), 0);
  tail_.AddLevel();
  tail_.Add(2, 1, 4);
  tail_.Add(2, 3, 8);
  tail_.Add(2, 0, 100);  // Asks for nothing.
  tail_.AddLevel();
  tail_.Add(2, 5, 100);  // Too late.
  tail_.Finish(nullptr);
  tail_.Solve(head_, y_);
  EXPECT_NEAR(y_[2], 7, Rounding(8, 3));
}

TEST_F(SelectionTailTest, FinishesAtTargetsWhereThereAreSome) {
  tail_.Clear();
  const double targets[3] = {1, 2, 9};
  tail_.AddLevel();
  tail_.Add(0, 1, 3);
  tail_.Finish(targets);
  tail_.Solve(head_, y_);
  EXPECT_NEAR(y_[0], 3, Rounding(3, 3));
  EXPECT_NEAR(y_[1], std::sqrt(2) - 3, Rounding(3, 3));
  EXPECT_NEAR(y_[2], 9, Rounding(9, 3));
}

// y = 1 + off above y = 1: relative to the two of them, or to where a correction
// starts.
TEST_F(SelectionTailTest, AGradientOfRoundingIsNone) {
  for (const double weight : {0.01, 4.0}) {
    for (const double part : {0.7e-13, 1.4e-13}) {
      for (const double start : {1.0, 7.0}) {
        const double size = start + 1, off = part * size;
        RowStack head(1, 1, 1);
        *head.row(head.AddRow(1 + off, 1)) = 1;
        head.FactorLevel();
        SelectionTail tail(1, 1);
        tail.AddLevel();
        tail.Add(0, weight, 1);
        tail.Finish(nullptr);
        double y, on_head = 5, left = 5;
        tail.Solve(head, &y);
        if (start != 1) {
          y = start;
          const double change = (1 + off - start) * head.basis()[0];
          tail.Correct(head, &change, true, &y);
        }
        const double found = tail.Dual(0, &on_head, &left);
        EXPECT_EQ(left, 5);
        if (part < 1e-13) {
          EXPECT_EQ(found, 0) << weight << ", " << start;
          EXPECT_EQ(on_head, 5) << weight << ", " << start;
        } else {
          EXPECT_NEAR(found, weight * size, weight * (off + Rounding(size, 1)))
              << weight << ", " << start;
        }
      }
    }
  }
}

// y0 + y1 and y0 + y1 + y2 are given: with y2, nothing more of y0 and y1. The
// levels are y2, y1, y0.
TEST_F(SelectionTailTest, CountsRowsWithoutWhatLaterLevelsHaveOfThem) {
  tail_.Clear();
  for (const int variable : {2, 1}) {
    tail_.AddLevel();
    tail_.Add(variable, 1, 0);
  }
  tail_.Finish(nullptr);
  const double rows[2][3] = {{1, 1, 0}, {1, 1, 1}};
  tail_.TieRows(rows[0], 3, 2);
  EXPECT_EQ(tail_.Nullity(0), 1);
  EXPECT_EQ(tail_.Nullity(1), 0);
}

// Divided by such weights, rows are nearly parallel.
TEST_F(SelectionTailTest, MeetsTheHeadWhereOneWeightIsSmall) {
  Eigen::Matrix<double, 3, 4> A;
  A << 1, 2, 3, -1, 2, 1, -1, 1, 1, -1, 1, 3;
  A.rowwise().normalize();
  RowStack head(4, 3, 1);
  for (int a = 0; a < 3; ++a) {
    Eigen::Vector4d::Map(head.row(head.AddRow(1 + a, 1))) = A.row(a);
  }
  head.FactorLevel();
  const Eigen::Vector4d weight(1e-12, 1, 2, 3), target(3, 5, -1, 2);
  SelectionTail tail(4, 1);
  tail.AddLevel();
  for (int j = 0; j < 4; ++j) tail.Add(j, weight[j], target[j]);
  tail.Finish(nullptr);
  Eigen::Vector4d y;
  tail.Solve(head, y.data());
  // Of rows of length 1e6, each entry to its last digit.
  EXPECT_LE((A * y - Eigen::Vector3d(1, 2, 3)).norm(), Rounding(10, 4, 1e6));
}

TEST_F(SelectionTailTest, DoesNotAllocate) {
  double on_head[1], left[3];
  const CountMalloc count;
  tail_.Clear();
  AddOnce();
  tail_.Solve(head_, y_);
  tail_.Dual(0, on_head, left);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
