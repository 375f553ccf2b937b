// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/math/rank.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// y1 = 1 twice and y1 = 3 once, in one level; then y1 = 5, y2 = 7.
class LexicographicFactorizationTest : public testing::Test {
 protected:
  LexicographicFactorizationTest() {
    LeastSquares first;
    first.A.resize(2, 2);
    first.A << 1, 0, 1, 0;
    first.b = Eigen::Vector2d(1, 3);
    first.weight = Eigen::Vector2d(1, 3);
    AddLevel(first, &stack_);
    LeastSquares second;
    second.A.setIdentity(2, 2);
    second.b = Eigen::Vector2d(5, 7);
    second.weight = Eigen::Vector2d(2, 4);
    AddLevel(second, &stack_);
  }
  LexicographicFactorization stack_{2, 4, 2};
};

TEST_F(LexicographicFactorizationTest, SolvesByHand) {
  const Eigen::VectorXd y = Optimum(stack_, 2);
  EXPECT_NEAR(y[0], 2.5, Rounding(5, 2));
  EXPECT_NEAR(y[1], 7, Rounding(7, 2));
  EXPECT_NEAR(stack_.residual(0), 1.5, Rounding(5, 2));
  EXPECT_NEAR(stack_.residual(1), -0.5, Rounding(5, 2));
  EXPECT_NEAR(stack_.residual(2), -2.5, Rounding(5, 2));
  EXPECT_EQ(stack_.residual(3), 0);
  double gradient[1];
  EXPECT_NEAR(stack_.Gradient(1, gradient), 5, Rounding(5, 2));
  EXPECT_NEAR(gradient[0] * stack_.basis()[0], -5, Rounding(5, 2));
}

TEST_F(LexicographicFactorizationTest,
       MeetsIndependentRowsWhateverTheirMetric) {
  LexicographicFactorization stack(2, 2, 1);
  LeastSquares level;
  level.A.resize(2, 2);
  level.A << 1, 0, 0.6, 0.8;
  level.b = Eigen::Vector2d(1, 2);
  level.weight = Eigen::Vector2d(1e-12, 1e12);
  AddLevel(level, &stack);
  EXPECT_LE((level.A * Optimum(stack, 2) - level.b).norm(), Rounding(2, 2, 4));
}

// Two rows at a small angle, in one level or in two.
TEST_F(LexicographicFactorizationTest, CountsARowOfWhichSomethingIsLeft) {
  for (const int num_levels : {1, 2}) {
    for (const double rest : {0.25, 10.0}) {
      LexicographicFactorization stack(3, 2, 2);
      stack.AddRow(1, 1);
      Eigen::Vector3d::Map(stack.row(0)) << 0.6, 0.8, 0;
      if (num_levels == 2) stack.FactorLevel();
      const int a = stack.AddRow(1, 1);
      Eigen::Vector3d::Map(stack.row(a)) << 0.6, 0.8, rest * kRankTolerance;
      stack.FactorLevel();
      EXPECT_EQ(stack.rank(), rest > 1 ? 2 : 1) << num_levels << ", " << rest;
    }
  }
}

// What is left of such rows after one projection is far from orthogonal.
TEST_F(LexicographicFactorizationTest, OrthogonalisesWhatIsNearlyParallel) {
  constexpr int kSize = 6;
  for (const double angle : {0.5, 1e-2, 1e-5, 1e-8}) {
    for (const int rows_a_level : {1, 2, kSize}) {
      LexicographicFactorization stack(kSize, kSize, kSize);
      for (int i = 0; i < kSize; ++i) {
        Eigen::VectorXd row = Eigen::VectorXd::Constant(kSize, 1);
        row[i] += angle * (1 + i);
        row.normalize();
        const int a = stack.AddRow(1, 1);
        Eigen::VectorXd::Map(stack.row(a), kSize) = row;
        if ((i + 1) % rows_a_level == 0) stack.FactorLevel();
      }
      ASSERT_EQ(stack.rank(), kSize);
      const Eigen::MatrixXd Q = Basis(stack, kSize);
      EXPECT_LE(
          (Q * Q.transpose() - Eigen::MatrixXd::Identity(kSize, kSize)).norm(),
          Rounding(1, kSize))
          << angle << ", " << rows_a_level;
    }
  }
}

// Less than a thousandth of it, or in a space that is full.
TEST_F(LexicographicFactorizationTest, AppendsNoRowThatNearlyDependsOnOthers) {
  for (const double rest : {0.5e-3, 2e-3}) {
    LexicographicFactorization stack(2, 3, 1);
    stack.AddRow(1, 1);
    Eigen::Vector2d::Map(stack.row(0)) << 0.6, 0.8;
    stack.FactorLevel();
    Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 0.6 - 0.8 * rest,
        0.8 + 0.6 * rest;
    const bool is_good = rest > 1e-3;
    EXPECT_EQ(stack.AppendRow(), is_good) << rest;
    EXPECT_EQ(stack.num_rows(), is_good ? 2 : 1) << rest;
    EXPECT_EQ(stack.rank(), is_good ? 2 : 1) << rest;
    EXPECT_EQ(stack.is_well_conditioned(), true) << rest;
    if (!is_good) continue;
    Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 0, 1;
    EXPECT_FALSE(stack.AppendRow());
    EXPECT_EQ(stack.num_rows(), 2);
  }
}

// The last row, on its own or with the one it nearly depends on.
TEST_F(LexicographicFactorizationTest,
       IsWellConditionedWhereEachRowHasAGoodPart) {
  EXPECT_FALSE(stack_.is_well_conditioned());  // Two rows are the same.
  for (const int num_levels : {1, 2}) {
    for (const double rest : {0.7e-3, 1.4e-3}) {
      LexicographicFactorization stack(4, 3, 2);
      Eigen::Vector4d::Map(stack.row(stack.AddRow(1, 1))) << 1, 0, 0, 0;
      Eigen::Vector4d::Map(stack.row(stack.AddRow(1, 1))) << 0, 0.6, 0.8, 0;
      if (num_levels == 2) stack.FactorLevel();
      Eigen::Vector4d::Map(stack.row(stack.AddRow(1, 1))) << 0, 0.6, 0.8, rest;
      stack.FactorLevel();
      ASSERT_EQ(stack.rank(), 3);
      EXPECT_EQ(stack.is_well_conditioned(), rest > 1e-3)
          << num_levels << ", " << rest;
    }
  }
}

TEST_F(LexicographicFactorizationTest, AResidualOfRoundingIsNone) {
  // Relative to |y| + |target|, 2; or 11, where another entry is large.
  for (const double other : {0.0, 9.0}) {
    const double size = std::hypot(1, other) + 1;
    for (const double off : {0.7e-12, 1.4e-12}) {
      LexicographicFactorization stack(2, 3, 2);
      Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 1, 0;
      Eigen::Vector2d::Map(stack.row(stack.AddRow(other, 1))) << 0, 1;
      stack.FactorLevel();
      const int a = stack.AddRow(1 + off * size, 1);
      Eigen::Vector2d::Map(stack.row(a)) << 1, 0;
      stack.FactorLevel();
      if (off < 1e-12) {
        EXPECT_EQ(stack.residual(a), 0) << other;
      } else {
        EXPECT_NEAR(stack.residual(a), -off * size, Rounding(2, 2)) << other;
      }
    }
  }
}

// As long as the good part must be, to the bit, or a little less.
TEST_F(LexicographicFactorizationTest, AGoodPartIsAThousandthOfARow) {
  for (const double good : {1e-3, 0.999e-3}) {
    LexicographicFactorization stack(2, 3, 1);
    stack.row(stack.AddRow(1, 1))[0] = 1;
    stack.FactorLevel();
    stack.row(stack.AddRow(1, 1))[1] = good;
    EXPECT_EQ(stack.AppendRow(), good == 1e-3);
    stack.Truncate(0);
    Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << good, 0;
    stack.FactorLevel();
    EXPECT_EQ(stack.is_well_conditioned(), good == 1e-3);
  }
}

// Of each row appended, all but a few thousandths is in those before.
TEST_F(LexicographicFactorizationTest, OrthogonalisesWhatItAppends) {
  constexpr int kSize = 6;
  const Eigen::VectorXd mean = Eigen::VectorXd::LinSpaced(kSize, 1, 2.7);
  LexicographicFactorization stack(kSize, kSize, 1);
  for (int i = 0; i < kSize; ++i) {
    Eigen::VectorXd row = mean;
    if (i > 0) row[i] += 0.013 * mean.norm();
    Eigen::VectorXd::Map(stack.row(stack.AddRow(1, 1)), kSize) =
        row.normalized();
    if (i == 0) {
      stack.FactorLevel();
    } else {
      ASSERT_TRUE(stack.AppendRow()) << i;
    }
    const Eigen::MatrixXd Q = Basis(stack, kSize);
    EXPECT_LE(
        (Q * Q.transpose() - Eigen::MatrixXd::Identity(i + 1, i + 1)).norm(),
        Rounding(1, 2))
        << i;
  }
}

TEST_F(LexicographicFactorizationTest, MergedLevelsAreEmptyButTheLast) {
  LexicographicFactorization stack(3, 3, 3);
  for (int level = 0; level < 3; ++level) {
    stack.row(stack.AddRow(5 + level, 2 + level))[level] = 1;
    stack.FactorLevel();
  }
  stack.Merge(3);
  ASSERT_EQ(stack.num_levels(), 3);
  for (int level = 0; level < 3; ++level) {
    EXPECT_EQ(stack.first_row(level), 0) << level;
    EXPECT_EQ(stack.end_row(level), level < 2 ? 0 : 3) << level;
    EXPECT_EQ(stack.rank(level), level < 2 ? 0 : 3) << level;
    EXPECT_FALSE(stack.is_deficient(level)) << level;
    double gradient = 5;
    EXPECT_EQ(stack.Gradient(level, &gradient), 0) << level;
    EXPECT_EQ(gradient, 5) << level;
  }
  stack.RemoveRow(0);  // The last one takes its number, and its weight.
  EXPECT_EQ(stack.weight(0), 16);
  EXPECT_EQ(stack.weight(1), 9);
  stack.SolveLast();
  EXPECT_EQ(Optimum(stack, 3), Eigen::Vector3d(0, 6, 7));
  stack.Merge(0);
  EXPECT_EQ(stack.num_levels(), 0);
  EXPECT_EQ(stack.num_rows(), 0);
  EXPECT_EQ(stack.rank(), 0);
}

// Many more variables than rows, and as many.
TEST_F(LexicographicFactorizationTest, HasRoomForManyVariables) {
  constexpr int kSize = 40;
  for (const int rows : {1, kSize}) {
    Eigen::MatrixXd A(rows, kSize);
    LexicographicFactorization stack(kSize, rows, 1);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < kSize; ++j) {
        A(i, j) = (i == j ? kSize : 0) + (7 * i + 3 * j) % 11 / 10.0;
      }
      A.row(i).normalize();
      Eigen::VectorXd::Map(stack.row(stack.AddRow(i + 1, 1)), kSize) = A.row(i);
    }
    stack.FactorLevel();
    const Eigen::VectorXd residual =
        Eigen::VectorXd::LinSpaced(rows, 1, rows) - A * Optimum(stack, kSize);
    EXPECT_LE(residual.norm(), Rounding(kSize, kSize));
  }
}

TEST_F(LexicographicFactorizationTest, HasRoomForManyRows) {
  constexpr int kRows = 99;
  LexicographicFactorization stack(1, kRows, 1);
  for (int a = 0; a < kRows; ++a) *stack.row(stack.AddRow(a, 1)) = 1;
  stack.FactorLevel();
  EXPECT_NEAR(Optimum(stack, 1)[0], kRows / 2, Rounding(kRows, kRows));
}

// Two forces that all but cancel, relative to the larger one.
TEST_F(LexicographicFactorizationTest, AGradientOfRoundingIsNone) {
  for (const double off : {0.7e-12, 1.4e-12}) {
    LexicographicFactorization stack(2, 4, 2);
    for (int a = 0; a < 2; ++a) stack.row(stack.AddRow(0, 1))[a] = 1;
    stack.FactorLevel();
    stack.row(stack.AddRow(5, 2))[1] = 1;
    stack.row(stack.AddRow(5, 1))[1] = 1;
    stack.FactorLevel();
    const double residual[2] = {1, -4 * (1 + off)};
    stack.SetResiduals(1, residual, 0);
    double gradient[2];
    const double size = stack.Gradient(1, gradient);
    if (off < 1e-12) {
      EXPECT_EQ(size, 0);
    } else {
      EXPECT_NEAR(size, 4, Rounding(4, 2) + 4 * off);
    }
  }
}

TEST_F(LexicographicFactorizationTest, TakesResidualsForTheGradient) {
  EXPECT_NEAR(stack_.weight(1), 3, Rounding(3, 1));
  EXPECT_NEAR(stack_.weight(2), 2, Rounding(2, 1));
  const double residual[2] = {10, 7};
  stack_.SetResiduals(1, residual, 1);
  EXPECT_NEAR(stack_.residual(2), 10, Rounding(10, 1));
  EXPECT_EQ(stack_.residual(3), 0);  // A row that is met.
  double gradient[1];
  EXPECT_NEAR(stack_.Gradient(1, gradient), 20, Rounding(20, 2));
  EXPECT_NEAR(gradient[0] * stack_.basis()[0], 20, Rounding(20, 2));
}

// y = 0 and, 1e12 times lighter, y = 1: at the optimum the heavy row lacks 1e-12
// of what the light one does, to the last digit, though y may be off by more.
TEST_F(LexicographicFactorizationTest,
       WhatAHeavyRowLacksHasAsManyDigitsAsALightOnes) {
  LexicographicFactorization stack(1, 2, 1);
  *stack.row(stack.AddRow(0, 1e3)) = 1;
  *stack.row(stack.AddRow(1, 1e-3)) = 1;
  stack.FactorLevel();
  for (const double off : {0.0, 1e-9}) {
    if (off > 0) {
      const double residual[2] = {off, -1};
      stack.SetResiduals(0, residual, 1);
    }
    const double light = (1 + off) / (1 + 1e-12);
    EXPECT_NEAR(stack.residual(0), 1e-12 * light, Rounding(1e-12, 4));
    EXPECT_NEAR(stack.residual(1), -light, Rounding(1, 4));
  }
}

// One of two rows on y1 = 0 and y2 = 0 each is off by 0.7 or 1.4 times what is
// zero beside what it is added up from; then y1's by that beside y2's.
TEST_F(LexicographicFactorizationTest, WhatIsKeptIsNoRounding) {
  for (const double off : {0.7e-12, 1.4e-12}) {
    LexicographicFactorization stack(2, 4, 1);
    for (int a = 0; a < 4; ++a) {
      stack.row(stack.AddRow(0, 3))[a / 2] = 1;
      stack.row(a)[1 - a / 2] = 0;
    }
    stack.FactorLevel();
    const double lonely[4] = {-5 * off, 5 * off, 0, 0};
    stack.SetResiduals(0, lonely, 5);
    // A half of it is each row's.
    const double left = off < 1e-12 ? 0 : 5 * off;
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(std::abs(stack.residual(a)), left, Rounding(left, 4)) << off;
    }
    const double beside[4] = {-off, off, -1, 1};
    stack.SetResiduals(0, beside, 0);
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(std::abs(stack.residual(a)), off < 1e-12 ? 0 : off,
                  Rounding(1, 4))
          << off;
    }
  }
}

// Small numbers, after large ones that are gone.
TEST_F(LexicographicFactorizationTest, AResidualIsJudgedByItsOwnLevel) {
  LexicographicFactorization stack(1, 3, 1);
  for (const double scale : {1.0, 1e-15}) {
    stack.Truncate(0);
    *stack.row(stack.AddRow(0, 1)) = 1;
    *stack.row(stack.AddRow(2 * scale, 1)) = 1;
    if (scale == 1) *stack.row(stack.AddRow(1, 1)) = 1;
    stack.FactorLevel();
    EXPECT_NEAR(stack.residual(0), scale, Rounding(scale, 4));
    EXPECT_NEAR(stack.residual(1), -scale, Rounding(scale, 4));
  }
}

// Rows of y that a level above has fixed, the heavy one at either place.
TEST_F(LexicographicFactorizationTest, WhatIsKeptIsNoRoundingOfAHeavyRow) {
  for (const int heavy : {0, 1}) {
    for (const double light : {0.7, 1.4}) {
      LexicographicFactorization stack(1, 3, 2);
      *stack.row(stack.AddRow(0, 1)) = 1;
      stack.FactorLevel();
      for (int i = 0; i < 2; ++i) {
        *stack.row(stack.AddRow(0, i == heavy ? 1e6 : 1)) = 1;
      }
      stack.FactorLevel();
      double residual[2] = {light, light};
      residual[heavy] = 1;  // Its force is 1e12.
      stack.SetResiduals(1, residual, 0);
      EXPECT_EQ(stack.residual(1 + heavy), 1);
      EXPECT_EQ(stack.residual(2 - heavy), light < 1 ? 0 : light) << heavy;
      // Beside 1 of the light one, 1e-14 by its length is rounding, whatever it
      // weighs.
      residual[heavy] = light * 1e-20;
      residual[1 - heavy] = 1;
      stack.SetResiduals(1, residual, 0);
      EXPECT_EQ(stack.residual(2 - heavy), 1);
      EXPECT_EQ(stack.residual(1 + heavy), light < 1 ? 0 : light * 1e-20);
    }
  }
}

TEST_F(LexicographicFactorizationTest, DoesNotAllocate) {
  LexicographicFactorization stack(2, 4, 2);
  double force[2] = {1, 2}, nu[4], residual[4] = {}, change[2];
  const CountMalloc count;
  for (int repeat = 0; repeat < 2; ++repeat) {
    stack.Truncate(0);
    for (int a = 0; a < 4; ++a) {
      stack.AddRow(a, 1);
      stack.row(a)[0] = a % 2;
      stack.row(a)[1] = (a + 1) % 2;
      if (a % 2 == 1) stack.FactorLevel();
    }
    stack.Gradient(1, force);
    stack.SolveDual(2, force, nu);
    stack.Correct(residual, change);
    stack.Merge(1);
    stack.RemoveRow(0);
    stack.AddRow(1, 1);
    stack.row(1)[1] = 1;
    stack.row(1)[0] = 0;
    EXPECT_TRUE(stack.AppendRow());
    stack.SolveLast();
  }
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
