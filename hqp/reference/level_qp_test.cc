// Compares the QP of one level with the best of all active sets, tried one by
// one. Also tests numbers near the thresholds below which they are zero.
#include "poise/hqp/reference/level_qp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "poise/math/rank.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Far above rounding, and far below the difference between two active sets of
// such numbers.
constexpr double kSame = 1e-9;

constexpr double kEps = std::numeric_limits<double>::epsilon();

class LevelQpTest : public testing::TestWithParam<RowSpaceMethod> {
 protected:
  static int Solve(LevelQp* qp, int max_iterations = 100) {
    return SolveLevelQp(GetParam(), max_iterations, qp);
  }
};

// Returns the QP min 1/2 |M z + m|^2, with the start z = 0 and the rows P z +
// value, without bounds.
LevelQp MakeQp(const MatrixXd& M, const VectorXd& m, const MatrixXd& P,
               bool soft) {
  LevelQp qp;
  qp.M = M;
  qp.m = m;
  qp.M_norm = M.rowwise().norm();
  qp.M_size = m.cwiseAbs();
  qp.P = P;
  qp.P_norm = P.rowwise().norm();
  qp.value = VectorXd::Zero(P.rows());
  qp.lower = VectorXd::Constant(P.rows(), -INFINITY);
  qp.upper = VectorXd::Constant(P.rows(), INFINITY);
  qp.size = VectorXd::Ones(P.rows());
  qp.soft.assign(P.rows(), soft);
  qp.side.assign(P.rows(), Side::kNone);
  qp.z = VectorXd::Zero(M.cols());
  return qp;
}

MatrixXd Row(const VectorXd& entries) { return entries.transpose(); }
MatrixXd Number(double entry) { return MatrixXd::Constant(1, 1, entry); }
VectorXd Numbers(double entry) { return VectorXd::Constant(1, entry); }

VectorXd Violation(const LevelQp& qp, const VectorXd& z) {
  const VectorXd at = qp.P * z + qp.value;
  return (at - qp.upper).cwiseMax(qp.lower - at).cwiseMax(0);
}

double Cost(const LevelQp& qp, const VectorXd& z) {
  double cost = (qp.M * z + qp.m).squaredNorm() / 2;
  const VectorXd violation = Violation(qp, z);
  for (int i = 0; i < violation.size(); ++i) {
    if (qp.soft[i]) cost += violation[i] * violation[i] / 2;
  }
  return cost;
}

bool KeepsHardRows(const LevelQp& qp, const VectorXd& z) {
  const VectorXd violation = Violation(qp, z);
  for (int i = 0; i < violation.size(); ++i) {
    if (!qp.soft[i] && violation[i] > kSame * qp.P_norm[i]) return false;
  }
  return true;
}

// Returns the least cost of all active sets that meet the hard rows. Each row
// is absent, or at its lower or upper bound. Hard rows are solved first, then
// all rows with a cost.
double LeastCost(const LevelQp& qp) {
  const int n = static_cast<int>(qp.M.cols());
  const int rows = static_cast<int>(qp.P.rows());
  double least = INFINITY;
  for (int code = 0; code < std::pow(3, rows); ++code) {
    std::vector<LeastSquares> levels{{MatrixXd(0, n), VectorXd(0), VectorXd(0)},
                                     {qp.M, -qp.m, VectorXd()}};
    bool exists = true;
    for (int i = 0, rest = code; i < rows; ++i, rest /= 3) {
      if (rest % 3 == 0) continue;
      const double bound = rest % 3 == 1 ? qp.lower[i] : qp.upper[i];
      exists &= std::isfinite(bound);
      LeastSquares& level = levels[qp.soft[i]];
      const double unit = qp.soft[i] ? 1 : qp.P.row(i).norm();
      level.A.conservativeResize(level.A.rows() + 1, n);
      level.A.bottomRows(1) = qp.P.row(i) / unit;
      level.b.conservativeResize(level.b.size() + 1);
      level.b.tail(1) << (bound - qp.value[i]) / unit;
    }
    if (!exists) continue;
    for (LeastSquares& level : levels) level.weight.setOnes(level.b.size());
    const VectorXd z = SolveLexicographically(n, levels).y;
    if (KeepsHardRows(qp, z)) least = std::min(least, Cost(qp, z));
  }
  return least;
}

// Returns a random QP with few variables and rows, some of them repeated. The
// start z meets the hard rows, some of them exactly at the bound. Violated soft
// rows are in the working set. Other soft rows are in the working set at
// random.
LevelQp DrawQp(int seed) {
  std::mt19937 random(seed);
  const auto below = [&](int bound) {
    return static_cast<int>(random() % bound);
  };
  const auto number = [&] { return (below(601) - 300) / 100.0; };
  const int n = 1 + below(3), rows = below(5);
  MatrixXd M = MatrixXd::NullaryExpr(below(4), n, number);
  MatrixXd P = MatrixXd::NullaryExpr(rows, n, number);
  for (int i = 1; i < rows; ++i) {
    if (below(5) == 0) P.row(i) = P.row(i - 1);
  }
  for (int i = 0; i < rows; ++i) {
    if (P.row(i).norm() < 0.1) P(i, 0) = 1;
    P.row(i) *= std::pow(10, below(3) - 1);
  }
  LevelQp qp = MakeQp(M, VectorXd::NullaryExpr(M.rows(), number), P, false);
  qp.M_norm *= 1 + below(2);
  qp.P_norm *= 1 + below(2);
  qp.z = VectorXd::NullaryExpr(n, number);
  for (int i = 0; i < rows; ++i) {
    qp.value[i] = number();
    const double at = qp.P.row(i).dot(qp.z) + qp.value[i];
    qp.soft[i] = below(2) == 0;
    const double unit = qp.P_norm[i];
    const auto gap = [&] {
      return unit * std::max(0, below(300) - 100) / 100.0;
    };
    if (below(3) > 0) qp.upper[i] = at + gap();
    if (below(3) > 0) qp.lower[i] = at - gap();
    if (qp.soft[i]) {
      const double shift = unit * number();
      qp.lower[i] += shift;
      qp.upper[i] += shift;
      const Side guess = static_cast<Side>(below(3) - 1);
      const bool is_there = guess == Side::kLower   ? std::isfinite(qp.lower[i])
                            : guess == Side::kUpper ? std::isfinite(qp.upper[i])
                                                    : true;
      qp.side[i] = at > qp.upper[i]   ? Side::kUpper
                   : at < qp.lower[i] ? Side::kLower
                   : is_there         ? guess
                                      : Side::kNone;
    }
  }
  return qp;
}

TEST_P(LevelQpTest, FindsTheBestOfAllActiveSets) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const LevelQp drawn = DrawQp(seed);
    LevelQp qp = drawn;
    const int iterations = Solve(&qp);
    ASSERT_GT(iterations, 0);
    EXPECT_TRUE(KeepsHardRows(qp, qp.z));
    EXPECT_NEAR(Cost(qp, qp.z), LeastCost(qp), kSame * (1 + Cost(qp, qp.z)));
    // Each active row is at its bound or, if soft, violated. Each violated row
    // is active.
    const VectorXd at = qp.P * qp.z + qp.value;
    for (int i = 0; i < at.size(); ++i) {
      SCOPED_TRACE(i);
      const double zero = kSame * qp.P_norm[i];
      const double above = at[i] - qp.upper[i], below = qp.lower[i] - at[i];
      if (qp.side[i] == Side::kUpper) {
        EXPECT_NEAR(above, std::max(above, 0.), zero);
      } else if (qp.side[i] == Side::kLower) {
        EXPECT_NEAR(below, std::max(below, 0.), zero);
      } else {
        EXPECT_LE(std::max(above, below), zero);
      }
    }
    // This number of iterations suffices. With one less, the hard rows are
    // still met.
    LevelQp again = drawn;
    EXPECT_EQ(Solve(&again, iterations), iterations);
    EXPECT_EQ(again.z, qp.z);
    LevelQp stopped = drawn;
    EXPECT_EQ(Solve(&stopped, iterations - 1), -1);
    EXPECT_TRUE(KeepsHardRows(stopped, stopped.z));
  }
}

TEST_P(LevelQpTest, ReturnsTheMinimumNormSolution) {
  LevelQp qp =
      MakeQp(Row(Eigen::Vector2d(3, 4)), Numbers(-25), MatrixXd(0, 2), false);
  EXPECT_EQ(Solve(&qp), 1);
  EXPECT_LE((qp.z - Eigen::Vector2d(3, 4)).norm(), Rounding(5, 2));
}

TEST_P(LevelQpTest, IgnoresARowOfZeros) {
  LevelQp qp = MakeQp(MatrixXd::Identity(2, 2), Eigen::Vector2d(-2, 7),
                      MatrixXd(0, 2), false);
  qp.M(1, 1) = 0;
  qp.M_norm[1] = 0;
  EXPECT_EQ(Solve(&qp), 1);
  EXPECT_LE((qp.z - Eigen::Vector2d(2, 0)).norm(), Rounding(2, 2));
}

// A projection leaves 4 rest of a row of norm 4. If this is rounding of a sum
// of a hundred terms, it does not give a step of 1 / rest. Any larger row is
// met.
TEST_P(LevelQpTest, TreatsRoundingRemainderOfARowAsZero) {
  const auto solve = [](double rest) {
    LevelQp qp = MakeQp(Number(4 * rest), Numbers(-4), MatrixXd(0, 1), false);
    qp.M_norm[0] = 4;
    EXPECT_EQ(Solve(&qp), 1);
    return qp.z[0];
  };
  for (const double rest : {1e-30, kEps, 100 * kEps}) {
    EXPECT_EQ(solve(rest), 0) << rest;
  }
  for (const double rest : {1e-9, 1e-6, 1e-3, 1.}) {
    EXPECT_NEAR(solve(rest), 1 / rest, Rounding(1 / rest, 1)) << rest;
  }
}

// Independent rows are all met, whatever their norms.
TEST_P(LevelQpTest, MeetsIndependentRowsOfAnyNorm) {
  for (const double norm : {1e-100, 1e-20, 1e-9, 1., 1e9, 1e20, 1e100}) {
    MatrixXd M(2, 2);
    M << norm, 0, 0, 4;
    LevelQp qp =
        MakeQp(M, Eigen::Vector2d(-3 * norm, -8), MatrixXd(0, 2), false);
    EXPECT_EQ(Solve(&qp), 1);
    EXPECT_LE((qp.z - Eigen::Vector2d(3, 2)).norm(), Rounding(4, 2)) << norm;
  }
}

// A large-norm row conflicts with two small-norm rows. The optimum is the point
// on the line of the large-norm row that is closest to (1, 0).
TEST_P(LevelQpTest, KeepsSmallNormRowsAccurateBesideALargeNormRow) {
  const double large = 1e12;
  MatrixXd M(3, 2);
  M << 1, 0, 0, 1, 0.6 * large, 0.8 * large;
  LevelQp qp =
      MakeQp(M, Eigen::Vector3d(-1, 0, -0.3 * large), MatrixXd(0, 2), false);
  EXPECT_EQ(Solve(&qp), 1);
  EXPECT_LE((qp.z - Eigen::Vector2d(0.82, -0.24)).norm(), Rounding(1, 3));
}

// The hard row 4 (slope z0 + z1) = 0, with the target z0 = 8. z1 is exact to
// kRankTolerance. A slope that is rounding of a sum of a hundred terms blocks
// no step.
TEST_P(LevelQpTest, MeetsAHardRowOfAnySlopeAlongTheStep) {
  for (const double size :
       {0., 1e-20, 100 * kEps, 1e-12, 1e-9, 1e-6, 1e-3, 1.}) {
    for (const double slope : {-size, size}) {
      SCOPED_TRACE(slope);
      LevelQp qp = MakeQp(Row(Eigen::Vector2d(1, 0)), Numbers(-8),
                          4 * Row(Eigen::Vector2d(slope, 1)), false);
      qp.lower << 0;
      qp.upper << 0;
      const int iterations = Solve(&qp);
      ASSERT_GT(iterations, 0);
      EXPECT_LE(iterations, size <= 100 * kEps ? 1 : 2);
      EXPECT_NEAR(qp.z[0], 8, Rounding(8, 2));
      EXPECT_NEAR(qp.z[1], -8 * slope, 8 * kRankTolerance);
    }
  }
}

// A soft row starts in the working set. The optimum is then z = -sign 3 gap,
// which does not violate the row. So the row is removed, whatever the gap, and
// z becomes -sign 6 gap. If the gap is below rounding of the size of the row,
// 3, both z are the same.
TEST_P(LevelQpTest, RemovesASoftRowThatIsNotViolated) {
  for (const double gap : {1e-20, kEps, 1e-14, 1e-13, 1e-9, 1e-3, 1e3}) {
    for (const Side side : {Side::kLower, Side::kUpper}) {
      SCOPED_TRACE(testing::Message() << gap << static_cast<int>(side));
      const double sign = static_cast<double>(side);
      LevelQp qp = MakeQp(Number(1), Numbers(sign * 6 * gap), Number(1), true);
      (side == Side::kUpper ? qp.upper : qp.lower) << 0;
      qp.size << 3;
      qp.side[0] = side;
      EXPECT_GT(Solve(&qp), 0);
      EXPECT_NEAR(qp.z[0], -sign * 6 * gap, Rounding(std::max(3., 6 * gap), 1));
    }
  }
}

// The rows z >= 3, and z >= 2 with 1e7 times the norm, are both in the working
// set. Their optimum is inside the bound of the large-norm row by 1e-14 of the
// bound, less than rounding of many terms. The large-norm row is removed
// nevertheless, because the small-norm row has a residual of 1.
TEST_P(LevelQpTest, RemovesALargeNormRowForTheResidualOfASmallNormRow) {
  LevelQp qp =
      MakeQp(MatrixXd(0, 1), VectorXd(0), Eigen::Vector2d(1e7, 1), true);
  qp.lower << 2e7, 3;
  qp.size = qp.lower;
  qp.side = {Side::kLower, Side::kLower};
  EXPECT_GT(Solve(&qp), 0);
  EXPECT_EQ(qp.side[0], Side::kNone);
  EXPECT_NEAR(qp.z[0], 3, Rounding(3, 2));
}

// A hard row at its bound, whose multiplier `rest` is a difference of 2 |1| and
// 1 |2 - rest|. The optimum is -rest / 5, or the bound if that is nearer. If
// the multiplier is below kNegligible of its terms, whose sum is 4, the row may
// stay: z then changes by at most 4e-12 / 5.
TEST_P(LevelQpTest, RemovesAHardRowWithANegativeMultiplier) {
  for (const double size : {0., 1e-20, 1e-15, 1e-10, 1e-6, 1e-3, 1.}) {
    for (const double rest : {-size, size}) {
      for (const Side side : {Side::kLower, Side::kUpper}) {
        SCOPED_TRACE(testing::Message() << rest << static_cast<int>(side));
        const double sign = static_cast<double>(side);
        LevelQp qp =
            MakeQp(Eigen::Vector2d(2, -1), Eigen::Vector2d(1, 2 - sign * rest),
                   Number(3), false);
        (side == Side::kUpper ? qp.upper : qp.lower) << 0;
        qp.side[0] = side;
        EXPECT_GT(Solve(&qp), 0);
        EXPECT_NEAR(qp.z[0], -sign * std::max(rest, 0.) / 5,
                    4e-12 / 5 + Rounding(1, 2));
      }
    }
  }
}

// If two rows have the same multiplier, the first one is removed.
TEST_P(LevelQpTest, RemovesTheRowWithTheMostNegativeMultiplierFirst) {
  for (int most = 0; most < 2; ++most) {
    LevelQp qp = MakeQp(MatrixXd::Identity(2, 2), Eigen::Vector2d(-1, -1),
                        -MatrixXd::Identity(2, 2), false);
    // Without the rows the optimum is z = (1, 1). With both active, the row
    // with the larger multiplier is removed first.
    qp.M(most, most) = 3;
    qp.m[most] = -3;
    qp.M_norm[most] = 3;
    qp.upper.setZero();
    qp.side.assign(2, Side::kUpper);
    EXPECT_EQ(Solve(&qp, 1), -1);
    EXPECT_EQ(qp.side[most], Side::kNone);
    EXPECT_EQ(qp.side[1 - most], Side::kUpper);
  }
  LevelQp even = MakeQp(MatrixXd::Identity(2, 2), Eigen::Vector2d(-1, -1),
                        MatrixXd::Identity(2, 2), false);
  even.lower.setZero();
  even.side.assign(2, Side::kLower);
  EXPECT_EQ(Solve(&even, 1), -1);
  EXPECT_EQ(even.side[0], Side::kNone);
  EXPECT_EQ(even.side[1], Side::kLower);
}

// A row whose terms are zero at the start is at its bound there, but is not
// violated at the optimum. By least squares, z = (-3, 83) / 17.
TEST_P(LevelQpTest, RemovesARowThatIsZeroAtTheStart) {
  MatrixXd P(2, 2);
  P << 1, 0, 10, 1;
  LevelQp qp =
      MakeQp(MatrixXd::Identity(2, 2), Eigen::Vector2d(-1, -5), P, true);
  qp.upper << 0, 3;
  qp.size << 0, 3;
  EXPECT_GT(Solve(&qp), 0);
  EXPECT_LE((qp.z - Eigen::Vector2d(-3, 83) / 17).norm(), Rounding(5, 2, 100));
  EXPECT_EQ(qp.side[0], Side::kNone);
  EXPECT_EQ(qp.side[1], Side::kUpper);
}

// Beale's example: removing the most negative multiplier cycles through steps
// of length zero. min -3/4 z0 + 20 z1 - 1/2 z2 + 6 z3.
TEST_P(LevelQpTest, EndsOnBealesCyclingExample) {
  MatrixXd P(7, 4);
  P << 0.25, -8, -1, 9,   //
      0.5, -12, -0.5, 3,  //
      0, 0, 1, 0,         //
      -1, 0, 0, 0,        //
      0, -1, 0, 0,        //
      0, 0, -1, 0,        //
      0, 0, 0, -1;
  LevelQp qp =
      MakeQp(Row(Eigen::Vector4d(-0.75, 20, -0.5, 6)), Numbers(100), P, false);
  qp.P_norm.setOnes();
  qp.upper << 0, 0, 1, 0, 0, 0, 0;
  for (int i = 3; i < 7; ++i) qp.side[i] = Side::kUpper;
  // The first ten iterations per row cycle. Bland's rule ends after 15 more.
  EXPECT_EQ(Solve(&qp), 85);
  EXPECT_LE((qp.z - Eigen::Vector4d(1, 0, 1, 0)).norm(), Rounding(20, 4, 20));
}

// The row 1 <= z <= 2 is violated at z = 5. A target of -10 is beyond its other
// bound, 1, so the row is added at that bound. At a target of 1.5 the row is
// inactive.
TEST_P(LevelQpTest, MovesASoftRowFromOneBoundToTheOther) {
  for (const double sign : {1., -1.}) {
    for (const double desired : {-10., 1.5}) {
      LevelQp qp =
          MakeQp(Number(10), Numbers(-10 * desired * sign), Number(1), true);
      qp.value[0] = -20 * sign;
      qp.lower[0] = -18.5 * sign - 0.5;
      qp.upper[0] = -18.5 * sign + 0.5;
      qp.z[0] = 5 * sign;
      qp.side[0] = sign > 0 ? Side::kUpper : Side::kLower;
      EXPECT_EQ(Solve(&qp), 2);
      if (desired > 0) {
        EXPECT_EQ(qp.side[0], Side::kNone);
        EXPECT_NEAR(qp.z[0], desired * sign, Rounding(2, 2));
      } else {
        EXPECT_EQ(qp.side[0], sign > 0 ? Side::kLower : Side::kUpper);
        // 10 (10 z + 100) = 1 - z.
        EXPECT_NEAR(qp.z[0], -999. / 101 * sign, Rounding(20, 2));
      }
    }
  }
}

// z <= start is in the working set, and the optimum is start - off. The
// residual is a difference of numbers near 1, with a rounding of eps. The row
// may stay only if `off` is below that.
TEST_P(LevelQpTest, RemovesARowForAResidualAboveRounding) {
  for (const double start : {0., 1.}) {
    for (const double off : {1e-20, 1e-16, 1e-14, 1e-13, 1e-6, 1.}) {
      SCOPED_TRACE(testing::Message() << start << ", " << off);
      LevelQp qp = MakeQp(Number(1), Numbers(off), Number(1), false);
      qp.M_size << 1 - start;
      qp.upper << 0;
      qp.side[0] = Side::kUpper;
      qp.z << start;
      qp.m[0] -= start;
      qp.value[0] = -start;
      EXPECT_GT(Solve(&qp), 0);
      EXPECT_NEAR(qp.z[0], start - off, Rounding(2, 1));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothWays, LevelQpTest,
                         testing::Values(RowSpaceMethod::kSvd,
                                         RowSpaceMethod::kCod));

}  // namespace
}  // namespace poise
