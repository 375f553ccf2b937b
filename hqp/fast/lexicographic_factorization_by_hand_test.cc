// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// Level 0: y0 = 1 with weight 1, and y0 = 3 with weight 3. Level 1: y0 = 5 with
// weight 2, and y1 = 7 with weight 4.
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
  EXPECT_NEAR(gradient[0] * stack_.free_basis()[0], -5, Rounding(5, 2));
}

// Level 0 then has its optimum at (1 * 9 + 3 * 1) / 4, and level 1 keeps y1.
TEST_F(LexicographicFactorizationTest, SolvesAgainForOtherTargets) {
  stack_.SetTarget(0, 9);
  stack_.SetTarget(1, 1);
  stack_.SolveFrom(0);
  Eigen::VectorXd y = Optimum(stack_, 2);
  EXPECT_NEAR(y[0], 3, Rounding(9, 2));
  EXPECT_NEAR(y[1], 7, Rounding(9, 2));
  EXPECT_NEAR(stack_.residual(0), -6, Rounding(9, 2));
  EXPECT_NEAR(stack_.residual(2), -2, Rounding(9, 2));
  // A level does not see targets of later ones.
  stack_.SetTarget(3, -7);
  stack_.SolveFrom(1);
  y = Optimum(stack_, 2);
  EXPECT_NEAR(y[0], 3, Rounding(9, 2));
  EXPECT_NEAR(y[1], -7, Rounding(9, 2));
}

TEST_F(LexicographicFactorizationTest, MeetsIndependentRowsOfAnyMetric) {
  LexicographicFactorization stack(2, 2, 1);
  LeastSquares level;
  level.A.resize(2, 2);
  level.A << 1, 0, 0.6, 0.8;
  level.b = Eigen::Vector2d(1, 2);
  level.weight = Eigen::Vector2d(1e-12, 1e12);
  AddLevel(level, &stack);
  EXPECT_LE((level.A * Optimum(stack, 2) - level.b).norm(), Rounding(2, 2, 4));
}

// Three rows of large weight contradict each other, and one of small weight has
// a variable of its own, so that it is met, in any order of the rows. If it
// were orthogonalised before the others, the rounding of their residuals would
// outweigh it.
TEST_F(LexicographicFactorizationTest, MeetsARowOfSmallWeightInAnyOrder) {
  const Eigen::RowVector3d small(0.36, 0.48, 0.8);
  const RowMajorMatrix large{{1, 0, 0}, {0.6, 0.8, 0}, {0.28, 0.96, 0}};
  for (int place = 0; place < 4; ++place) {
    SCOPED_TRACE(place);
    LexicographicFactorization stack(3, 4, 1);
    LeastSquares level;
    level.A.resize(4, 3);
    level.A << large.topRows(place), small, large.bottomRows(3 - place);
    level.b = Eigen::Vector4d(1, -2, 5, 3);
    level.weight.setConstant(4, 1e12);
    level.weight[place] = 1;
    AddLevel(level, &stack);
    EXPECT_NEAR(small.dot(Optimum(stack, 3)), level.b[place], Rounding(10, 3));
  }
}

// Two rows at an angle `rest`, on one level or on two, with targets 1 and 2. If
// the angle is rounding, the rows are dependent, and y2 does not become 1 /
// rest. At any larger angle both rows are met.
TEST_F(LexicographicFactorizationTest, TreatsRoundingRemainderOfARowAsZero) {
  for (const int num_levels : {1, 2}) {
    const auto solve = [&](double rest) {
      LexicographicFactorization stack(3, 2, 2);
      stack.AddRow(1, 1);
      Eigen::Vector3d::Map(stack.row(0)) << 0.6, 0.8, 0;
      if (num_levels == 2) stack.FactorLevel();
      const int a = stack.AddRow(2, 1);
      Eigen::Vector3d::Map(stack.row(a)) << 0.6, 0.8, rest;
      stack.FactorLevel();
      return Optimum(stack, 3);
    };
    for (const double rest : {0., 1e-30, kEps, 100 * kEps}) {
      SCOPED_TRACE(testing::Message() << num_levels << ", " << rest);
      const double along = num_levels == 1 ? 1.5 : 1;
      EXPECT_LE((solve(rest) - along * Eigen::Vector3d(0.6, 0.8, 0)).norm(),
                Rounding(2, 3) + 2 * rest);
    }
    for (const double rest : {1e-9, 1e-6, 1e-3, 1.}) {
      SCOPED_TRACE(testing::Message() << num_levels << ", " << rest);
      const Eigen::Vector3d y = solve(rest);
      EXPECT_NEAR(0.6 * y[0] + 0.8 * y[1], 1, Rounding(1, 3, 1 / rest));
      EXPECT_NEAR(y[2] * rest, 1, Rounding(1, 3, 1 / rest));
    }
  }
}

// After one projection, the remainders of nearly parallel rows are far from
// orthogonal.
TEST_F(LexicographicFactorizationTest, OrthogonalisesNearlyParallelRows) {
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

// An appended row is met like a factored one. AppendRow() rejects a row that
// nearly depends on others, or for which no dimension is left, so that no
// update loses digits. The factorisation is then unchanged.
TEST_F(LexicographicFactorizationTest,
       RejectsAnAppendedRowThatIsNearlyDependent) {
  for (const double rest : {0., 1e-12, 1e-9, 1e-6, 3e-6, 1e-2, 0.1, 1.}) {
    SCOPED_TRACE(rest);
    LexicographicFactorization stack(2, 3, 1);
    stack.AddRow(1, 1);
    Eigen::Vector2d::Map(stack.row(0)) << 0.6, 0.8;
    stack.FactorLevel();
    const Eigen::Vector2d row =
        Eigen::Vector2d(0.6 - 0.8 * rest, 0.8 + 0.6 * rest).normalized();
    Eigen::Vector2d::Map(stack.row(stack.AddRow(2, 1))) = row;
    const bool is_independent = rest > 1e-3;
    EXPECT_EQ(stack.AppendRow(), is_independent);
    EXPECT_EQ(stack.num_rows(), is_independent ? 2 : 1);
    EXPECT_EQ(stack.rank(), is_independent ? 2 : 1);
    EXPECT_TRUE(stack.is_well_conditioned());
    stack.SolveLast();
    const Eigen::VectorXd y = Optimum(stack, 2);
    EXPECT_NEAR(0.6 * y[0] + 0.8 * y[1], 1, Rounding(1, 2, 1e2));
    if (!is_independent) continue;
    EXPECT_NEAR(row.dot(y), 2, Rounding(2, 2, 1e2));
    Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 0, 1;
    EXPECT_FALSE(stack.AppendRow());
    EXPECT_EQ(stack.num_rows(), 2);
  }
}

// In a well-conditioned factorisation each row counts for one in the nullity.
// The last row is alone on its level, or on the same level as the row that it
// depends on.
TEST_F(LexicographicFactorizationTest, DetectsNearlyDependentRows) {
  EXPECT_FALSE(stack_.is_well_conditioned());  // Two rows are the same.
  for (const int num_levels : {1, 2}) {
    for (const double rest : {1e-9, 3e-6, 1e-2, 1.}) {
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

// Level 0: y0 = 1 and y1 = `other`. Level 1: y0 = 1 + off. The residual is
// -off, to rounding of |y| + |target|, which is 2, or about 10 if `other` is 9.
// A residual that is rounding becomes zero.
TEST_F(LexicographicFactorizationTest, TreatsRoundingResidualAsZero) {
  for (const double other : {0.0, 9.0}) {
    const double size = std::hypot(1, other) + 1;
    for (const double part : {0., kEps, 100 * kEps, 1e-10, 1e-6, 1e-2}) {
      SCOPED_TRACE(testing::Message() << other << ", " << part);
      LexicographicFactorization stack(2, 3, 2);
      Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 1, 0;
      Eigen::Vector2d::Map(stack.row(stack.AddRow(other, 1))) << 0, 1;
      stack.FactorLevel();
      const int a = stack.AddRow(1 + part * size, 1);
      Eigen::Vector2d::Map(stack.row(a)) << 1, 0;
      stack.FactorLevel();
      const bool is_rounding = part <= 100 * kEps;
      EXPECT_NEAR(stack.residual(a), is_rounding ? 0 : -part * size,
                  is_rounding ? 0 : Rounding(size, 2));
    }
  }
}

// Only some thousandths of each appended row are independent of the rows before
// it.
TEST_F(LexicographicFactorizationTest, OrthogonalisesAppendedRows) {
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

TEST_F(LexicographicFactorizationTest, MergesLevelsIntoTheLast) {
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
  stack.RemoveRow(0);  // The last row moves into its place.
  EXPECT_EQ(stack.weight(0), 16);
  EXPECT_EQ(stack.weight(1), 9);
  stack.SolveLast();
  EXPECT_EQ(Optimum(stack, 3), Eigen::Vector3d(0, 6, 7));
  stack.Merge(0);
  EXPECT_EQ(stack.num_levels(), 0);
  EXPECT_EQ(stack.num_rows(), 0);
  EXPECT_EQ(stack.rank(), 0);
}

// One row of 40 variables, and 40 rows of 40 variables.
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

// Two terms of the gradient are 4 and -4 (1 + part). The gradient is relative
// to the larger one. A gradient that is rounding becomes zero.
TEST_F(LexicographicFactorizationTest, TreatsRoundingGradientAsZero) {
  for (const double part : {0., kEps, 100 * kEps, 1e-10, 1e-6, 1e-2}) {
    SCOPED_TRACE(part);
    LexicographicFactorization stack(2, 4, 2);
    for (int a = 0; a < 2; ++a) stack.row(stack.AddRow(0, 1))[a] = 1;
    stack.FactorLevel();
    stack.row(stack.AddRow(5, 2))[1] = 1;
    stack.row(stack.AddRow(5, 1))[1] = 1;
    stack.FactorLevel();
    const double residual[2] = {1, -4 * (1 + part)};
    stack.SetResiduals(1, residual, 0);
    double gradient[2];
    const double size = stack.Gradient(1, gradient);
    if (part <= 100 * kEps) {
      EXPECT_EQ(size, 0);
      continue;
    }
    EXPECT_NEAR(size, 4 * (1 + part), Rounding(4, 2));
    EXPECT_NEAR(gradient[0] * stack.free_basis()[1] +
                    gradient[1] * stack.free_basis()[stack.stride() + 1],
                -4 * part, Rounding(4, 2));
  }
}

TEST_F(LexicographicFactorizationTest, ComputesTheGradientFromGivenResiduals) {
  EXPECT_NEAR(stack_.weight(1), 3, Rounding(3, 1));
  EXPECT_NEAR(stack_.weight(2), 2, Rounding(2, 1));
  const double residual[2] = {10, 7};
  stack_.SetResiduals(1, residual, 1);
  EXPECT_NEAR(stack_.residual(2), 10, Rounding(10, 1));
  EXPECT_EQ(stack_.residual(3), 0);  // This row is met.
  double gradient[1];
  EXPECT_NEAR(stack_.Gradient(1, gradient), 20, Rounding(20, 2));
  EXPECT_NEAR(gradient[0] * stack_.free_basis()[0], 20, Rounding(20, 2));
}

// The rows y = 0, and y = 1 with 1e-12 of the weight. At the optimum the
// residual of the first row is 1e-12 of that of the second row. It is exact to
// the last digit, even if y is not.
TEST_F(LexicographicFactorizationTest,
       FindsTheResidualOfALargeWeightRowToAllDigits) {
  LexicographicFactorization stack(1, 2, 1);
  *stack.row(stack.AddRow(0, 1e3)) = 1;
  *stack.row(stack.AddRow(1, 1e-3)) = 1;
  stack.FactorLevel();
  for (const double off : {0.0, 1e-9}) {
    if (off > 0) {
      const double residual[2] = {off, -1};
      stack.SetResiduals(0, residual, 1);
    }
    const double small = (1 + off) / (1 + 1e-12);
    EXPECT_NEAR(stack.residual(0), 1e-12 * small, Rounding(1e-12, 4));
    EXPECT_NEAR(stack.residual(1), -small, Rounding(1, 4));
  }
}

// Two rows y0 = 0 and two rows y1 = 0. A residual of the rows of y0 that no y
// can remove is kept. It becomes zero if it is rounding of its own terms, here
// 5, or of the residual of the rows of y1.
TEST_F(LexicographicFactorizationTest, KeepsUnattainableResiduals) {
  for (const double part : {0., kEps, 100 * kEps, 1e-10, 1e-6, 1e-2}) {
    SCOPED_TRACE(part);
    LexicographicFactorization stack(2, 4, 1);
    for (int a = 0; a < 4; ++a) {
      stack.row(stack.AddRow(0, 3))[a / 2] = 1;
      stack.row(a)[1 - a / 2] = 0;
    }
    stack.FactorLevel();
    const bool is_rounding = part <= 100 * kEps;
    const double alone[4] = {-5 * part, 5 * part, 0, 0};
    stack.SetResiduals(0, alone, 5);
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(stack.residual(a), is_rounding ? 0 : alone[a],
                  Rounding(is_rounding ? 0 : 5 * part, 4));
    }
    const double beside[4] = {-part, part, -1, 1};
    stack.SetResiduals(0, beside, 0);
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(stack.residual(a), is_rounding ? 0 : beside[a],
                  is_rounding ? 0 : Rounding(1, 4));
    }
  }
}

// A level of small numbers, after a level of large numbers was removed.
TEST_F(LexicographicFactorizationTest, ComparesAResidualWithItsOwnLevelOnly) {
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

// Two rows with weights 1 and 1e12, of a y that the level above has fixed. If
// the large-weight row has a gradient of 1e12, a small residual of the other
// row is rounding. If the small-weight row has a residual of 1, a tiny residual
// of the other row is rounding of the reflections.
TEST_F(LexicographicFactorizationTest, TreatsRoundingOfALargeWeightRowAsZero) {
  for (const int large : {0, 1}) {
    LexicographicFactorization stack(1, 3, 2);
    *stack.row(stack.AddRow(0, 1)) = 1;
    stack.FactorLevel();
    for (int i = 0; i < 2; ++i) {
      *stack.row(stack.AddRow(0, i == large ? 1e6 : 1)) = 1;
    }
    stack.FactorLevel();
    for (const double small : {0., 1e-6, 1e-2, 1e2, 1e6}) {
      SCOPED_TRACE(testing::Message() << large << ", " << small);
      double residual[2] = {small, small};
      residual[large] = 1;  // Its part of the gradient is 1e12.
      stack.SetResiduals(1, residual, 0);
      EXPECT_EQ(stack.residual(1 + large), 1);
      EXPECT_EQ(stack.residual(2 - large), small <= 1e-2 ? 0 : small);
      // Metric times residual of the large-weight row is now small * 1e-14, and
      // that of the other row is 1. Below eps = 2e-16, this is rounding.
      residual[large] = small * 1e-20;
      residual[1 - large] = 1;
      stack.SetResiduals(1, residual, 0);
      EXPECT_EQ(stack.residual(2 - large), 1);
      const double kept = small <= 1e-2 ? 0 : small * 1e-20;
      EXPECT_NEAR(stack.residual(1 + large), kept, Rounding(kept, 1));
    }
  }
}

// y = (2, 3, 4) is determined by two fixed variables, y2 = 4 and y0 = 2, and by
// 0.6 y0 + 0.8 y1 = 3.6. The level after has the rows y1 = 1 and 0.6 y0 + 0.8
// y2 = 9.4, with the residuals 2 and -5 and the weights 1 and 4. Its gradient
// in y is then 2 e1 - 20 (0.6 e0 + 0.8 e2) = (-12, 2, -16).
TEST(LexicographicFactorizationOfFixedVariables, LeavesALevelWithoutFreedom) {
  LexicographicFactorization stack(3, 5, 2);
  const auto add = [&](double y0, double y1, double y2, double target,
                       double metric) {
    const double row[3] = {y0, y1, y2};
    stack.SetRow(stack.AddRow(target, metric), row, 0, 3, 1);
  };
  stack.AddFixedVariable(2, 1, 4, 1);
  stack.AddFixedVariable(0, -1, -2, 1);
  add(0.6, 0.8, 0, 3.6, 1);
  ASSERT_TRUE(stack.FactorMerged(1));
  add(0, 1, 0, 1, 1);
  add(0.6, 0, 0.8, 9.4, 2);
  stack.FactorLevel();
  EXPECT_TRUE(stack.is_deficient(1));
  EXPECT_EQ(stack.rank(1), 3);
  EXPECT_NEAR(stack.residual(3), 2, Rounding(4, 3));
  EXPECT_NEAR(stack.residual(4), -5, Rounding(9.4, 3));
  double gradient[3], y[3] = {};
  EXPECT_NEAR(stack.Gradient(1, gradient), 20, Rounding(40, 3));
  stack.AddCombination(gradient, 3, y);
  EXPECT_NEAR(y[0], -12, Rounding(40, 3));
  EXPECT_NEAR(y[1], 2, Rounding(40, 3));
  EXPECT_NEAR(y[2], -16, Rounding(40, 3));
  // With y2 = -1 instead, the second residual is 1.2 - 0.8 - 9.4 = -9.
  stack.SetTarget(0, -1);
  stack.SolveFrom(0);
  EXPECT_NEAR(stack.residual(3), 2, Rounding(4, 3));
  EXPECT_NEAR(stack.residual(4), -9, Rounding(9.4, 3));
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

// A level has 60 rows of rank 50. If it takes too many multiply-adds, it ends
// after one more row of Q or reflection. This takes less than three products of
// all rows, and of Q, with a row.
TEST(LexicographicFactorization, RemovesALevelSoonIfItTakesTooLong) {
  static constexpr int kVariables = 60, kRank = 50;
  const auto factor = [](std::int64_t most) {
    LexicographicFactorization stack(kVariables, kVariables, 1);
    stack.set_max_multiply_adds(most);
    for (int i = 0; i < kVariables; ++i) {
      Eigen::VectorXd row(kVariables);
      for (int j = 0; j < kVariables; ++j)
        row[j] = std::cos(1 + (i % kRank) * (j + 1.3));
      const int a = stack.AddRow(i, 1);
      stack.SetRow(a, row.data(), 0, kVariables, row.norm());
    }
    stack.FactorLevel();
    EXPECT_EQ(stack.num_levels(), stack.multiply_adds() <= most ? 1 : 0);
    return stack.multiply_adds();
  };
  const std::int64_t needed = factor(std::numeric_limits<std::int64_t>::max());
  const std::int64_t step =
      3 * 2 * kVariables * (kVariables + kernels::kRowOverhead);
  ASSERT_GT(needed, 10 * step);
  for (int part = 0; part < 20; ++part) {
    const std::int64_t most = part * needed / 20;
    const std::int64_t used = factor(most);
    EXPECT_GT(used, most) << part;
    EXPECT_LE(used, most + step) << part;
  }
}

}  // namespace
}  // namespace poise
