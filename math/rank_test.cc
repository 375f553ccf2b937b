// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/rank.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEps = std::numeric_limits<double>::epsilon();

MatrixXd Reshape(const VectorXd& x, int rows, int cols) {
  return Eigen::Map<const MatrixXd>(x.data(), rows, cols);
}

// Matrices up to 8 x 8. The rank is at most the drawn one.
rc::Gen<MatrixXd> Matrices() {
  return rc::gen::mapcat(
      rc::gen::tuple(rc::gen::inRange(1, 9), rc::gen::inRange(1, 9),
                     rc::gen::inRange(0, 9)),
      [](const std::tuple<int, int, int>& sizes) -> rc::Gen<MatrixXd> {
        const auto [rows, cols, rank] = sizes;
        return rc::gen::map(
            rc::gen::pair(VectorsXd(rows * rank, 10),
                          VectorsXd(rank * cols, 1)),
            [rows, cols,
             rank](const std::pair<VectorXd, VectorXd>& x) -> MatrixXd {
              return Reshape(x.first, rows, rank) *
                     Reshape(x.second, rank, cols);
            });
      });
}

// Returns an orthogonal matrix: singular vectors of a fixed matrix.
MatrixXd Orthogonal(int size, double seed) {
  MatrixXd A(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) A(i, j) = std::sin(seed + 7 * i + 3 * j * j);
  }
  return JacobiSvd(A).U;
}

double RoundingOf(const MatrixXd& A) {
  return Rounding(A.norm(), static_cast<int>(A.rows() + A.cols()));
}

RC_GTEST_PROP(RankRevealing, AgreesWithAnotherSvd, ()) {
  const MatrixXd A = *Matrices();
  RankRevealing decomposition(8, 8);
  decomposition.Compute(A);
  RC_ASSERT((decomposition.singular_values() - JacobiSvd(A).sigma).norm() <=
            RoundingOf(A));
  RC_ASSERT(decomposition.threshold() ==
            1e-11 * decomposition.singular_values()[0]);
}

RC_GTEST_PROP(RankRevealing, SplitsSpace, ()) {
  const MatrixXd A = *Matrices();
  RankRevealing decomposition(8, 8);
  decomposition.Compute(A);
  const int n = static_cast<int>(A.cols());
  MatrixXd V(n, n);
  V << decomposition.row_space(), decomposition.nullspace();
  RC_ASSERT((V.transpose() * V - MatrixXd::Identity(n, n)).norm() <=
            Rounding(1, 8 * n));
  RC_ASSERT((A * decomposition.nullspace()).norm() <= RoundingOf(A));
  // The first columns are right singular vectors: A'A v = sigma² v.
  for (int i = 0; i < decomposition.rank(); ++i) {
    const VectorXd v = V.col(i);
    const double sigma = decomposition.singular_values()[i];
    RC_ASSERT((A.transpose() * (A * v) - sigma * sigma * v).norm() <=
              RoundingOf(A) * A.norm());
  }
}

RC_GTEST_PROP(RankRevealing, SolvesAsAnotherDecompositionDoes, ()) {
  const MatrixXd A = *Matrices();
  const VectorXd b = *VectorsXd(static_cast<int>(A.rows()), 10);
  RankRevealing decomposition(9, 8);
  decomposition.Compute(A);
  const LeastSquaresSolution other(A, b);
  // If rounding decides the rank, the two may differ.
  RC_PRE(other.rank == decomposition.rank());
  VectorXd x(A.cols());
  decomposition.Solve(b, x);
  const double condition = decomposition.condition();
  RC_ASSERT((x - other.x).norm() <=
            Rounding(1 + other.x.norm() + b.norm(), 16, condition * condition));
}

TEST(RankRevealing, FindsAKnownRank) {
  for (const int rows : {1, 3, 7, 12}) {
    for (const int cols : {1, 4, 7, 11}) {
      for (int rank = 0; rank <= std::min(rows, cols); ++rank) {
        SCOPED_TRACE(testing::Message() << rows << 'x' << cols << ' ' << rank);
        // Singular values 1, 1/4, 1/16, ...
        MatrixXd A = MatrixXd::Zero(rows, cols);
        for (int i = 0; i < rank; ++i) {
          A += std::pow(4, -i) * Orthogonal(rows, 1).col(i) *
               Orthogonal(cols, 2).col(i).transpose();
        }
        RankRevealing decomposition(12, 11);
        decomposition.Compute(A);
        EXPECT_EQ(decomposition.rank(), rank);
        EXPECT_EQ(decomposition.row_space().cols(), rank);
        EXPECT_EQ(decomposition.nullspace().cols(), cols - rank);
        const double condition = rank == 0 ? 1 : std::pow(4, rank - 1);
        EXPECT_NEAR(decomposition.condition(), condition,
                    Rounding(condition, 8, condition));
        for (int i = 0; i < rank; ++i) {
          EXPECT_NEAR(decomposition.singular_values()[i], std::pow(4, -i),
                      Rounding(1, 8));
        }
      }
    }
  }
}

TEST(RankRevealing, CountsSingularValuesAboveTheThreshold) {
  RankRevealing decomposition(2, 3);
  MatrixXd A = MatrixXd::Zero(2, 3);
  A(0, 2) = 2;
  const double threshold = 2e-11;
  A(1, 0) = threshold;
  decomposition.Compute(A);
  EXPECT_EQ(decomposition.threshold(), threshold);
  EXPECT_EQ(decomposition.rank(), 1);
  A(1, 0) = threshold * (1 + 2 * kEps);
  decomposition.Compute(A);
  EXPECT_EQ(decomposition.rank(), 2);
}

TEST(RankRevealing, ComparesARemainderWithItsOriginal) {
  RankRevealing decomposition(2, 2);
  const MatrixXd A = 1e-11 * MatrixXd::Identity(2, 2);
  decomposition.Compute(A);
  EXPECT_EQ(decomposition.rank(), 2);
  decomposition.Compute(A, 1);
  EXPECT_EQ(decomposition.threshold(), 1e-11);
  EXPECT_EQ(decomposition.rank(), 0);
  EXPECT_EQ(decomposition.nullspace().cols(), 2);
}

TEST(RankRevealing, FindsSmallSingularValuesOfScaledRows) {
  // Orthogonal rows of norm 1 to 1e-12. Each singular value is the norm of a
  // row, to a few digits.
  const int n = 5;
  const MatrixXd Q = Orthogonal(n, 3);
  const VectorXd scales =
      (VectorXd(n) << 1e-3, 1e-12, 1, 1e-9, 1e-6).finished();
  RankRevealing decomposition(n, n);
  decomposition.Compute(scales.asDiagonal() * Q);
  for (int i = 0; i < n; ++i) {
    const double expected = std::pow(10, -3 * i);
    EXPECT_NEAR(decomposition.singular_values()[i] / expected, 1,
                Rounding(1, n));
  }
}

TEST(RankRevealing, HandlesNumbersOfAnySize) {
  const MatrixXd A = Orthogonal(4, 1);
  RankRevealing decomposition(4, 4);
  for (const double scale : {1e-290, 1e-200, 1e200, 1e300}) {
    SCOPED_TRACE(scale);
    decomposition.Compute(scale * A);
    EXPECT_EQ(decomposition.rank(), 4);
    EXPECT_NEAR(decomposition.singular_values()[0] / scale, 1, Rounding(1, 8));
    VectorXd x(4);
    decomposition.Solve(scale * A.col(1), x);
    EXPECT_LE((x - VectorXd::Unit(4, 1)).norm(), Rounding(1, 16));
  }
}

TEST(RankRevealing, WithoutRowsAllIsNullspace) {
  RankRevealing decomposition(3, 4);
  decomposition.Compute(MatrixXd(0, 4));
  EXPECT_EQ(decomposition.rank(), 0);
  EXPECT_EQ(decomposition.nullspace(), MatrixXd::Identity(4, 4));
  EXPECT_EQ(decomposition.condition(), 1);
  decomposition.Compute(MatrixXd(3, 0));
  EXPECT_EQ(decomposition.rank(), 0);
  EXPECT_EQ(decomposition.nullspace().size(), 0);
  decomposition.Compute(MatrixXd::Zero(3, 4));
  EXPECT_EQ(decomposition.rank(), 0);
  EXPECT_EQ(decomposition.nullspace().cols(), 4);
  VectorXd x = VectorXd::Ones(4);
  decomposition.Solve(VectorXd::Ones(3), x);
  EXPECT_EQ(x, VectorXd::Zero(4));
}

TEST(RankRevealing, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    MatrixXd A = MatrixXd::Identity(3, 4);
    A(1, 2) = bad;
    RankRevealing decomposition(5, 5);
    decomposition.Compute(A);
    EXPECT_EQ(decomposition.rank(), 0);
    EXPECT_TRUE(std::isnan(decomposition.threshold()));
    EXPECT_TRUE(std::isnan(decomposition.condition()));
    EXPECT_TRUE(decomposition.singular_values().array().isNaN().all());
    EXPECT_TRUE(decomposition.nullspace().array().isNaN().all());
    VectorXd x = VectorXd::Ones(4);
    decomposition.Solve(VectorXd::Ones(3), x);
    EXPECT_TRUE(x.array().isNaN().all());
  }
}

TEST(RankRevealing, AllocatesAndThrowsNothing) {
  RankRevealing decomposition(12, 9);
  const MatrixXd A = Orthogonal(12, 1).leftCols(9);
  const MatrixXd B = Orthogonal(9, 1).topRows(4);
  const VectorXd b = VectorXd::Ones(4);
  VectorXd x(9);
  CountMalloc count;
  decomposition.Compute(A);
  decomposition.Compute(B);
  decomposition.Solve(b, x);
  const double sum =
      decomposition.nullspace().sum() + decomposition.row_space().sum() +
      decomposition.singular_values().sum() + decomposition.condition();
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_EQ(decomposition.rank(), 4);
  EXPECT_NE(sum, 0);
  const Eigen::Ref<const MatrixXd> A_ref(A);
  static_assert(noexcept(decomposition.Compute(A_ref, 0)));
}

}  // namespace
}  // namespace poise
