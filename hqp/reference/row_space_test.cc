// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/reference/row_space.h"

#include <gtest/gtest.h>

#include <limits>

#include "poise/math/rank.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

class RowSpaceTest : public testing::TestWithParam<RowSpaceMethod> {
 protected:
  static RowSpace Make(const Eigen::MatrixXd& M) {
    return MakeRowSpace(M, GetParam());
  }
};

TEST_P(RowSpaceTest, HasRankZeroWithoutRowsOrVariables) {
  const RowSpace no_rows = Make(Eigen::MatrixXd(0, 3));
  EXPECT_EQ(no_rows.rank, 0);
  EXPECT_EQ(no_rows.V, Eigen::MatrixXd::Identity(3, 3));
  const RowSpace no_variables = Make(Eigen::MatrixXd(3, 0));
  EXPECT_EQ(no_variables.rank, 0);
  EXPECT_EQ(no_variables.V.size(), 0);
}

// A unit row after a projection. Its remaining length is zero if it is rounding
// of a sum of a hundred terms, or equal to the threshold. A length of 1e-9 is
// not zero.
TEST_P(RowSpaceTest, IgnoresRoundingOfADependentRow) {
  const auto rank = [](double entry) {
    return Make(Eigen::MatrixXd::Constant(1, 1, entry)).rank;
  };
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  for (const double entry : {0., 1e-30, kEps, 100 * kEps, kRankTolerance}) {
    EXPECT_EQ(rank(entry), 0) << entry;
  }
  for (const double entry : {1e-9, 1e-6, 1e-3, 1.}) {
    EXPECT_EQ(rank(entry), 1) << entry;
    EXPECT_EQ(rank(-entry), 1) << entry;
  }
}

// Rows of unit length, some of them combinations of others. The columns of V
// beyond the rank are orthogonal to every row, and V is an orthogonal matrix.
TEST_P(RowSpaceTest, SplitsSpaceIntoRowsAndNullspace) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    for (const LeastSquares& level : MakeRandomLevels(seed)) {
      const int n = static_cast<int>(level.A.cols());
      const LexicographicOptimum known = SolveLexicographically(n, {level});
      const RowSpace space = Make(level.A);
      EXPECT_EQ(space.rank, known.rank[0]);
      ASSERT_EQ(space.V.rows(), n);
      ASSERT_EQ(space.V.cols(), n);
      EXPECT_LE(
          (space.V.transpose() * space.V - Eigen::MatrixXd::Identity(n, n))
              .norm(),
          Rounding(1, n));
      EXPECT_LE((level.A * space.V.rightCols(n - space.rank)).norm(),
                Rounding(1, n, known.condition));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothWays, RowSpaceTest,
                         testing::Values(RowSpaceMethod::kSvd,
                                         RowSpaceMethod::kCod));

}  // namespace
}  // namespace poise
