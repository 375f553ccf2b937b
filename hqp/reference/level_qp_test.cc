// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// One level's QP against the best of all active sets, tried one by one, and at
// the edges of what counts as nothing.
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

// Far above rounding, far below what other active sets of such numbers give.
constexpr double kSame = 1e-9;

constexpr double kEps = std::numeric_limits<double>::epsilon();

class LevelQpTest : public testing::TestWithParam<RowSpaceMethod> {
 protected:
  static int Solve(LevelQp* qp, int max_iterations = 100) {
    return SolveLevelQp(GetParam(), max_iterations, qp);
  }
};

// min 1/2 |M z + m|^2 from z = 0, with as many rows P z + value as are given,
// none of them with a bound yet.
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

// Each row absent, at its lower or at its upper bound: the hard ones first,
// then all that costs.
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

// Few variables and rows, some repeated; z somewhere, and hard rows that it
// keeps, or is just at the bound of; of soft rows that are not violated, any
// guess.
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
    // An active row is at its bound or, if soft, violated. Every violated row is
    // active.
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
    // That many are enough; one less is not, and leaves hard rows kept.
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

// A projection leaves 4 rest of a row of length 4. Rounding of a sum of a
// hundred terms is not to become a step of 1 / rest; every larger row is met.
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

// A large row after small ones in conflict: the point of its line that is next
// to (1, 0).
TEST_P(LevelQpTest, KeepsSmallRowsAccurateBesideALargeOne) {
  const double large = 1e12;
  MatrixXd M(3, 2);
  M << 1, 0, 0, 1, 0.6 * large, 0.8 * large;
  LevelQp qp =
      MakeQp(M, Eigen::Vector3d(-1, 0, -0.3 * large), MatrixXd(0, 2), false);
  EXPECT_EQ(Solve(&qp), 1);
  EXPECT_LE((qp.z - Eigen::Vector2d(0.82, -0.24)).norm(), Rounding(1, 3));
}

// 4 (slope z0 + z1) = 0 at z0 = 8: z1 follows to the last digit that a rank
// decision leaves. Rounding of a sum of a hundred terms blocks no step.
TEST_P(LevelQpTest, KeepsAHardRowForAnySlopeAlongTheStep) {
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

// A soft row, guessed to be violated, would hold z at half of -sign 6 gap. It
// is removed, whatever the gap is; below rounding of its size 3, z is the same.
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

// z >= 3 and, 1e7 times as long, z >= 2, both in the working set. The optimum
// of the two is inside the long row's bound by 1e-14 of it, less than rounding
// of many terms. The row is removed all the same, because the short one misses
// 1.
TEST_P(LevelQpTest, RemovesALargeRowForTheResidualOfASmallOne) {
  LevelQp qp =
      MakeQp(MatrixXd(0, 1), VectorXd(0), Eigen::Vector2d(1e7, 1), true);
  qp.lower << 2e7, 3;
  qp.size = qp.lower;
  qp.side = {Side::kLower, Side::kLower};
  EXPECT_GT(Solve(&qp), 0);
  EXPECT_EQ(qp.side[0], Side::kNone);
  EXPECT_NEAR(qp.z[0], 3, Rounding(3, 2));
}

// A hard row at its bound, with a multiplier that is a difference: `rest` of 2
// |1| + 1 |2 - rest|. The optimum is -rest / 5, or the bound if that is nearer;
// a multiplier below kNegligible of its four terms moves z by no more.
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

// If two rows have the same multiplier, the first is removed.
TEST_P(LevelQpTest, RemovesTheRowWithTheMostNegativeMultiplierFirst) {
  for (int most = 0; most < 2; ++most) {
    LevelQp qp = MakeQp(MatrixXd::Identity(2, 2), Eigen::Vector2d(-1, -1),
                        -MatrixXd::Identity(2, 2), false);
    // Towards z = (1, 1) either way; with both held, the larger pull is first.
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

// A row of size zero, at its bound where z starts, is not violated at the
// optimum: by least squares, z = (-3, 83) / 17.
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
  // Ten iterations a row cycle; Bland's rule ends after 15 more.
  EXPECT_EQ(Solve(&qp), 85);
  EXPECT_LE((qp.z - Eigen::Vector4d(1, 0, 1, 0)).norm(), Rounding(20, 4, 20));
}

// The row is violated above 2. A target of -10 is beyond its other bound, 1:
// the row is added there. At a target of 1.5 the row is inactive.
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
// residual is a difference of ones and has rounding of eps: only for less may
// the row stay.
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
