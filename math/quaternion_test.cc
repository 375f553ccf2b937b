// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/quaternion.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "poise/math/rpy.h"
#include "poise/math/so3.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const double kTolerance = Rounding(1, 4);

RC_GTEST_PROP(ExpQuaternion, IsTheRotationOfExpSo3, ()) {
  const Vector3d w = *RotationVectors(4 * M_PI);
  const Quaterniond q = ExpQuaternion(w);
  RC_ASSERT(std::abs(q.norm() - 1) <= kTolerance);
  RC_ASSERT((MatrixFromQuaternion(q) - ExpSo3(w)).norm() <= 2 * kTolerance);
}

TEST(ExpQuaternion, StoresXyzw) {
  const Vector3d w = 2 * std::atan(0.75) * Vector3d(2, -1, 2) / 3;
  const Eigen::Vector4d xyzw(0.4, -0.2, 0.4, 0.8);
  EXPECT_LE((ExpQuaternion(w).coeffs() - xyzw).norm(), kTolerance);
}

TEST(ExpQuaternion, CoversRotationsTwice) {
  EXPECT_LE((ExpQuaternion({0, 2 * M_PI, 0}).coeffs() +
             Quaterniond::Identity().coeffs())
                .norm(),
            kTolerance);
}

RC_GTEST_PROP(LogQuaternion, InvertsExp, ()) {
  const Vector3d w = *RotationVectors(M_PI - 1e-9);
  const Quaterniond q = ExpQuaternion(w);
  RC_ASSERT((LogQuaternion(q) - w).norm() <= kTolerance * w.norm());
}

RC_GTEST_PROP(LogQuaternion, DoesNotDependOnSignOrScale, ()) {
  const Vector3d w = *RotationVectors(M_PI - 1e-9);
  const Quaterniond q = ExpQuaternion(w);
  const Quaterniond minus(Eigen::Vector4d(-q.coeffs()));
  RC_ASSERT((LogQuaternion(minus) - w).norm() <= kTolerance * w.norm());
  const double scale = *rc::gen::element(1e-300, 1e-170, 1e-160, 1e-80, 2.0,
                                         1e80, 1e160, 1e170, 1e300);
  RC_PRE(w.isZero(0) || scale * w.stableNorm() > 1e-290);  // No subnormals.
  const Quaterniond scaled(Eigen::Vector4d(scale * q.coeffs()));
  RC_ASSERT((LogQuaternion(scaled) - w).norm() <= kTolerance * w.norm());
  RC_ASSERT((Normalize(scaled).coeffs() - q.coeffs()).norm() <= kTolerance);
}

TEST(Normalize, OfAnOrdinaryQuaternionDividesByItsNorm) {
  const Quaterniond q(0.7, -0.2, 0.5, 1.3);
  EXPECT_EQ(Normalize(q).coeffs(), Eigen::Vector4d(q.coeffs() / q.norm()));
}

TEST(Rescale, DividesByTheLargestComponent) {
  const Quaterniond q(1e300, -4e300, 2e300, 3e300);
  EXPECT_LE((Rescale(q).coeffs() - Eigen::Vector4d(-1, 0.5, 0.75, 0.25)).norm(),
            kTolerance);
}

TEST(IsSafeSquare, RejectsSquaresThatLoseDigits) {
  EXPECT_TRUE(IsSafeSquare(1.1e-200) && IsSafeSquare(0.9e200));
  EXPECT_FALSE(IsSafeSquare(1e-200) || IsSafeSquare(1e200));
  EXPECT_FALSE(IsSafeSquare(std::nan("")));
}

TEST(Normalize, OfZeroOrNotFiniteIsNan) {
  const Quaterniond zero(0, 0, 0, 0);
  EXPECT_TRUE(Normalize(zero).coeffs().array().isNaN().all());
  EXPECT_TRUE(LogQuaternion(zero).array().isNaN().all());
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 4; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Quaterniond q(0.5, 0.5, 0.5, 0.5);
      q.coeffs()[i] = bad;
      EXPECT_TRUE(Normalize(q).coeffs().array().isNaN().all());
    }
  }
}

TEST(LogQuaternion, OfTheIdentityIsZero) {
  EXPECT_EQ(LogQuaternion(Quaterniond(1, 0, 0, 0)), Vector3d::Zero());
  EXPECT_EQ(LogQuaternion(Quaterniond(-1, 0, 0, 0)), Vector3d::Zero());
}

TEST(LogQuaternion, OfAHalfTurnIsOneForBothQuaternions) {
  const Quaterniond q(0.0, 0.6, 0, -0.8), minus_q(-0.0, -0.6, 0, 0.8);
  EXPECT_LE((LogQuaternion(q) - M_PI * q.vec()).norm(), kTolerance);
  EXPECT_EQ(LogQuaternion(q), LogQuaternion(minus_q));
}

TEST(LogQuaternion, OfTinyVectorsIsExact) {
  EXPECT_EQ(LogQuaternion(Quaterniond(1, 1e-300, 0, 0)),
            Vector3d(2e-300, 0, 0));
  EXPECT_EQ(LogQuaternion(Quaterniond(-2, 0, 0, 4e-300)),
            Vector3d(0, 0, -4e-300));
}

TEST(LogQuaternion, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 4; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Quaterniond q(0.5, 0.5, 0.5, 0.5);
      q.coeffs()[i] = bad;
      EXPECT_TRUE(LogQuaternion(q).array().isNaN().all());
    }
    const Quaterniond scalar(bad, 0, 0, 0);
    EXPECT_TRUE(LogQuaternion(scalar).array().isNaN().all()) << bad;
  }
}

RC_GTEST_PROP(QuaternionFromMatrix, InvertsMatrixFromQuaternion, ()) {
  const Vector3d w = *RotationVectors(2 * M_PI);
  Quaterniond q = ExpQuaternion(w);
  const Quaterniond back = QuaternionFromMatrix(MatrixFromQuaternion(q));
  RC_ASSERT(back.w() >= 0);
  const Eigen::Vector4d x = q.coeffs(), y = back.coeffs();
  RC_ASSERT(std::min((x - y).norm(), (x + y).norm()) <= kTolerance);
}

TEST(QuaternionFromMatrix, OfHalfTurns) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d axis = Vector3d::Unit(i);
    const Matrix3d R = 2 * axis * axis.transpose() - Matrix3d::Identity();
    const Quaterniond q = QuaternionFromMatrix(R);
    EXPECT_EQ(q.w(), 0);
    EXPECT_EQ(q.vec(), axis);
  }
}

TEST(MatrixFromQuaternion, HasTheTextbookEntries) {
  const double x = 0.1, y = 0.5, z = -0.7, w = 0.5;
  Matrix3d expected;
  expected << w * w + x * x - y * y - z * z, 2 * (x * y - w * z),
      2 * (x * z + w * y), 2 * (x * y + w * z), w * w - x * x + y * y - z * z,
      2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
      w * w - x * x - y * y + z * z;
  EXPECT_LE((MatrixFromQuaternion(Quaterniond(w, x, y, z)) - expected).norm(),
            kTolerance);
}

TEST(Wxyz, PutsWFirst) {
  const Quaterniond q(0.1, 0.2, 0.3, 0.4);
  EXPECT_EQ(WxyzFromQuaternion(q), Eigen::Vector4d(0.1, 0.2, 0.3, 0.4));
  EXPECT_EQ(q.coeffs(), Eigen::Vector4d(0.2, 0.3, 0.4, 0.1));
  EXPECT_EQ(QuaternionFromWxyz({0.1, 0.2, 0.3, 0.4}).coeffs(), q.coeffs());
}

// For uniform rotations, each entry of R has mean 0 and mean square 1/3, each
// component of q mean 0 and mean square 1/4, and no two are correlated.
RC_GTEST_PROP(Wxyz, RoundTripKeepsAllNumbers, ()) {
  const Eigen::Vector3d a = *Vectors(), b = *Vectors();
  const Eigen::Vector4d wxyz(a.x(), a.y(), a.z(), b.x());
  const Quaterniond q = QuaternionFromWxyz(wxyz);
  RC_ASSERT(q.w() == wxyz[0]);
  RC_ASSERT(q.vec() == wxyz.tail<3>());
  RC_ASSERT(WxyzFromQuaternion(q) == wxyz);
}

TEST(UniformQuaternion, HasTheMomentsOfTheUniformDistribution) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform;
  Eigen::Matrix4d second = Eigen::Matrix4d::Zero();
  Eigen::Vector4d fourth = Eigen::Vector4d::Zero(), first = fourth;
  Matrix3d mean = Matrix3d::Zero();
  const int samples = 20000;
  for (int i = 0; i < samples; ++i) {
    const double a = uniform(generator), b = uniform(generator);
    const Quaterniond q = UniformQuaternion({a, b, uniform(generator)});
    ASSERT_NEAR(q.norm(), 1, kTolerance);
    first += q.coeffs() / samples;
    second += q.coeffs() * q.coeffs().transpose() / samples;
    fourth.array() += q.coeffs().array().pow(4) / samples;
    mean += MatrixFromQuaternion(q) / samples;
  }
  // Five standard deviations of the mean of so many numbers in [-1, 1] of mean
  // square at most 1/3.
  const double tolerance = 5 * std::sqrt(1.0 / 3 / samples);
  EXPECT_LE(first.cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((second - Eigen::Matrix4d::Identity() / 4).cwiseAbs().maxCoeff(),
            tolerance);
  EXPECT_LE((fourth.array() - 1.0 / 8).abs().maxCoeff(), tolerance);
  EXPECT_LE(mean.cwiseAbs().maxCoeff(), tolerance);
}

// The squares of its first two entries sum to 1 - u_0, of the others to u_0.
RC_GTEST_PROP(UniformQuaternion, SplitsItsNormByTheFirstNumber, ()) {
  Eigen::Vector3d u;
  for (double& each : u) each = *rc::gen::inRange(0, 1000) / 1000.0;
  const Quaterniond q = UniformQuaternion(u);
  RC_ASSERT(std::abs(q.norm() - 1) <= kTolerance);
  RC_ASSERT(std::abs(q.coeffs().head<2>().squaredNorm() - (1 - u[0])) <=
            kTolerance);
}

TEST(UniformQuaternion, FollowsItsNumbers) {
  EXPECT_LE(
      (UniformQuaternion({0, 0.25, 0.3}).coeffs() - Eigen::Vector4d(1, 0, 0, 0))
          .norm(),
      kTolerance);
  EXPECT_LE((UniformQuaternion({0.36, 0.5, 0.25}).coeffs() -
             Eigen::Vector4d(0, -0.8, 0.6, 0).eval())
                .norm(),
            kTolerance);
}

TEST(MatrixFromRpy, TurnsAboutFixedAxesInTurn) {
  const Vector3d rpy(0.3, -0.7, 2.5);
  const Matrix3d expected =
      ExpSo3({0, 0, rpy[2]}) * ExpSo3({0, rpy[1], 0}) * ExpSo3({rpy[0], 0, 0});
  EXPECT_LE((MatrixFromRpy(rpy) - expected).norm(), kTolerance);
}

RC_GTEST_PROP(RpyFromMatrix, InvertsMatrixFromRpy, ()) {
  const Vector3d rpy(*Numbers(3.1), *Numbers(1.5), *Numbers(3.1));
  // Near pitch ± π/2 roll and yaw come from entries of size cos(pitch).
  RC_ASSERT((RpyFromMatrix(MatrixFromRpy(rpy)) - rpy).norm() <=
            2 * kTolerance / std::cos(rpy[1]));
}

RC_GTEST_PROP(RpyFromMatrix, IsRightEvenWherePitchIsARightAngle, ()) {
  const double pitch = *rc::gen::element(-M_PI_2, M_PI_2, -1.5707, 1.57079632);
  const Matrix3d R = MatrixFromRpy({*Numbers(3), pitch, *Numbers(3)});
  const Vector3d rpy = RpyFromMatrix(R);
  RC_ASSERT(std::abs(rpy[1]) <= M_PI_2);
  RC_ASSERT((MatrixFromRpy(rpy) - R).norm() <= 2 * kTolerance);
}

TEST(RpyFromMatrix, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 9; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Matrix3d R = ExpSo3({1, 2, 3});
      R(i / 3, i % 3) = bad;
      EXPECT_TRUE(RpyFromMatrix(R).array().isNaN().all());
    }
  }
}

TEST(Quaternion, AllocatesAndThrowsNothing) {
  const Vector3d v(1, 2, 3);
  CountMalloc count;
  const Quaterniond q = ExpQuaternion(v);
  const Matrix3d R = MatrixFromQuaternion(q);
  const Vector3d w = LogQuaternion(QuaternionFromMatrix(R));
  const Vector3d rpy = RpyFromMatrix(MatrixFromRpy(w));
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_GT(rpy.norm() + UniformQuaternion({0.5, 0.5, 0.5}).norm(), 0);
  static_assert(noexcept(ExpQuaternion(v))&& noexcept(LogQuaternion(q)));
  static_assert(
      noexcept(QuaternionFromMatrix(R))&& noexcept(UniformQuaternion(v)));
  static_assert(noexcept(MatrixFromRpy(v))&& noexcept(RpyFromMatrix(R)));
}

}  // namespace
}  // namespace poise
