// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Leading level: y0 + y1 = sqrt(2). Diagonal level: y0 = 3 with weight 1, and
// y1 = 5 with weight 3. y2 has no target.
class DiagonalLevelsTest : public testing::Test {
 protected:
  DiagonalLevelsTest() {
    leading_.AddRow(1, 1);
    leading_.row(0)[0] = leading_.row(0)[1] = std::sqrt(0.5);
    leading_.FactorLevel();
    AddOnce();
  }
  void AddOnce() {
    diagonal_.AddLevel();
    diagonal_.Add(0, 1, 3);
    diagonal_.Add(1, 3, 5);
    diagonal_.Finish(nullptr);
  }
  LexicographicFactorization leading_{3, 1, 1};
  DiagonalLevels diagonal_{3, 2};
  double y_[3];
};

TEST_F(DiagonalLevelsTest, SolvesByHand) {
  diagonal_.Solve(leading_, y_);
  // The residual of the sum, 8 - sqrt(2), is divided in inverse proportion to
  // the weights.
  const double residual = 8 - std::sqrt(2);
  EXPECT_NEAR(y_[0], 3 - 0.75 * residual, Rounding(10, 3));
  EXPECT_NEAR(y_[1], 5 - 0.25 * residual, Rounding(10, 3));
  EXPECT_EQ(y_[2], 0);
  double on_leading[1], left[3];
  // The norm of |start| + |target|, divided by the squared entry of L, 1/2 +
  // 1/6.
  const double size = std::hypot(std::sqrt(0.5) + 3, std::sqrt(0.5) + 5);
  EXPECT_NEAR(diagonal_.Dual(leading_, 0, on_leading, left), 1.5 * size,
              Rounding(size, 3));
  EXPECT_NEAR(std::abs(on_leading[0]), 0.75 * residual * std::sqrt(2),
              Rounding(20, 3));
  EXPECT_EQ(diagonal_.Dual(leading_, 1, on_leading, left), 0);
  EXPECT_EQ(diagonal_.Nullity(0), 1);
  EXPECT_EQ(diagonal_.Nullity(1), 0);
}

// The size of a multiplier depends on the smallest weight of its row. Rounding
// of the large-weight variables does not count.
TEST_F(DiagonalLevelsTest, ScalesAMultiplierByTheSmallestWeightOfItsRow) {
  diagonal_.Clear();
  diagonal_.AddLevel();
  diagonal_.Add(0, 1, 3);
  diagonal_.Add(1, 1e12, 5);
  diagonal_.Finish(nullptr);
  diagonal_.Solve(leading_, y_);
  double on_leading[1], left[3];
  const double size = std::hypot(std::sqrt(0.5) + 3, std::sqrt(0.5) + 5);
  EXPECT_NEAR(diagonal_.Dual(leading_, 0, on_leading, left), 2 * size,
              1e-10);  // The large weight adds 1e-12.
}

// An entry of the gradient is rounded relative to weight (|y| + |target|). An
// entry of a few eps of that magnitude becomes zero.
TEST_F(DiagonalLevelsTest, ZeroesRoundingOfAGradient) {
  const double y[3] = {-1, 2, 0}, size[2] = {4, 21};
  for (const double part : {1e-20, 1e-15, 1e-11, 1e-6, 1.}) {
    for (const double sign : {-1, 1}) {
      const double given[2] = {sign * part * size[0], -sign * part * size[1]};
      double sum[3] = {given[0], given[1], 1e-30};
      diagonal_.ZeroRounding(0, y, sum);
      for (int j = 0; j < 2; ++j) {
        const double tolerance = part <= 1e-15 ? 0 : 1e-12 * size[j];
        EXPECT_NEAR(sum[j], part <= 1e-15 ? 0 : given[j], tolerance) << j;
      }
      EXPECT_EQ(sum[2], 1e-30);  // A variable of another level.
    }
  }
}

// IsMet() compares all variables of the level, and no others.
TEST_F(DiagonalLevelsTest, IsMetWhereEachVariableIsAtItsTarget) {
  const double met[3] = {3, 5, -1}, first[3] = {3, 4, 0},
               second[3] = {-3, 5, 0};
  EXPECT_TRUE(diagonal_.IsMet(0, met));
  EXPECT_FALSE(diagonal_.IsMet(0, first));
  EXPECT_FALSE(diagonal_.IsMet(0, second));
  EXPECT_FALSE(diagonal_.IsMet(1, met));
  const double other[3] = {0, 0, 0};
  EXPECT_TRUE(diagonal_.IsMet(1, other));
}

TEST_F(DiagonalLevelsTest, AveragesTwoTargetsOfALevel) {
  diagonal_.Clear();
  EXPECT_EQ(diagonal_.num_levels(), 0);
  diagonal_.AddLevel();
  diagonal_.Add(2, 1, 4);
  diagonal_.Add(2, 3, 8);
  diagonal_.Add(2, 0, 100);  // Weight zero: no effect.
  diagonal_.AddLevel();
  diagonal_.Add(2, 5, 100);  // Fixed by the first level: no effect.
  diagonal_.Finish(nullptr);
  diagonal_.Solve(leading_, y_);
  EXPECT_NEAR(y_[2], 7, Rounding(8, 3));
}

TEST_F(DiagonalLevelsTest, UsesTargetsForTheLastLevel) {
  diagonal_.Clear();
  const double targets[3] = {1, 2, 9};
  diagonal_.AddLevel();
  diagonal_.Add(0, 1, 3);
  diagonal_.Finish(targets);
  diagonal_.Solve(leading_, y_);
  EXPECT_NEAR(y_[0], 3, Rounding(3, 3));
  EXPECT_NEAR(y_[1], std::sqrt(2) - 3, Rounding(3, 3));
  EXPECT_NEAR(y_[2], 9, Rounding(9, 3));
}

// Leading level: y = 1 + off. Diagonal level: y = 1. The multiplier is -weight
// off, to rounding of weight (|y| + 1), after Solve() or after Correct() from
// another y. If `off` is rounding, the level has no multiplier.
TEST_F(DiagonalLevelsTest, FindsAMultiplierToRoundingOfItsTerms) {
  for (const double weight : {0.01, 4.0}) {
    for (const double part : {0., 1e-15, 1e-11, 1e-6, 1e-2}) {
      for (const double start : {1.0, 7.0}) {
        SCOPED_TRACE(testing::Message()
                     << weight << " " << part << " " << start);
        const double size = start + 1, off = part * size;
        LexicographicFactorization leading(1, 1, 1);
        *leading.row(leading.AddRow(1 + off, 1)) = 1;
        leading.FactorLevel();
        DiagonalLevels diagonal(1, 1);
        diagonal.AddLevel();
        diagonal.Add(0, weight, 1);
        diagonal.Finish(nullptr);
        double y, on_leading = 0, left = 5;
        diagonal.Solve(leading, &y);
        if (start != 1) {
          y = start;
          const double change = (1 + off - start) * leading.free_basis()[0];
          diagonal.Correct(leading, &change, true, &y);
        }
        EXPECT_NEAR(y, 1 + off, Rounding(size, 1));
        const double terms = diagonal.Dual(leading, 0, &on_leading, &left);
        EXPECT_EQ(left, 5);
        EXPECT_NEAR(on_leading * leading.free_basis()[0], -weight * off,
                    1e-12 * weight * size);
        EXPECT_NEAR(terms, part <= 1e-15 ? 0 : weight * size,
                    1e-12 * weight * size + weight * off);
      }
    }
  }
}

// The given sums y0 + y1 and y0 + y1 + y2 fix y2 and one of y0 and y1. The
// levels are y2, y1, y0.
TEST_F(DiagonalLevelsTest, SubtractsTheRowsOfLaterLevelsFromTheNullity) {
  diagonal_.Clear();
  for (const int variable : {2, 1}) {
    diagonal_.AddLevel();
    diagonal_.Add(variable, 1, 0);
  }
  diagonal_.Finish(nullptr);
  const double rows[2][3] = {{1, 1, 0}, {1, 1, 1}};
  diagonal_.TieRows(rows[0], 3, 2);
  EXPECT_EQ(diagonal_.Nullity(0), 1);
  EXPECT_EQ(diagonal_.Nullity(1), 0);
}

// Divided by the roots of such weights, the rows are nearly parallel.
TEST_F(DiagonalLevelsTest, MeetsTheLeadingLevelsWhereOneWeightIsSmall) {
  Eigen::Matrix<double, 3, 4> A;
  A << 1, 2, 3, -1, 2, 1, -1, 1, 1, -1, 1, 3;
  A.rowwise().normalize();
  LexicographicFactorization leading(4, 3, 1);
  for (int a = 0; a < 3; ++a) {
    Eigen::Vector4d::Map(leading.row(leading.AddRow(1 + a, 1))) = A.row(a);
  }
  leading.FactorLevel();
  const Eigen::Vector4d weight(1e-12, 1, 2, 3), target(3, 5, -1, 2);
  DiagonalLevels diagonal(4, 1);
  diagonal.AddLevel();
  for (int j = 0; j < 4; ++j) diagonal.Add(j, weight[j], target[j]);
  diagonal.Finish(nullptr);
  Eigen::Vector4d y;
  diagonal.Solve(leading, y.data());
  // The rows have length 1e6 after the division.
  EXPECT_LE((A * y - Eigen::Vector3d(1, 2, 3)).norm(), Rounding(10, 4, 1e6));
}

TEST_F(DiagonalLevelsTest, DoesNotAllocate) {
  double on_leading[1], left[3];
  const CountMalloc count;
  diagonal_.Clear();
  AddOnce();
  diagonal_.Solve(leading_, y_);
  diagonal_.Dual(leading_, 0, on_leading, left);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
