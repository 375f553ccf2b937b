// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/so3.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/math/quaternion.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const double kNan = std::nan("");
const double kInfinity = HUGE_VAL;

// Rounding of a product of a few rotations.
const double kRotationTolerance = Rounding(1, 4);

TEST(Hat, HasTheEntriesOfTheCrossProduct) {
  Matrix3d expected;
  expected << 0, -3, 2, 3, 0, -1, -2, 1, 0;
  EXPECT_EQ(Hat({1, 2, 3}), expected);
}

RC_GTEST_PROP(Hat, IsTheCrossProduct, ()) {
  const Vector3d w = *Vectors(), v = *Vectors();
  RC_ASSERT(Hat(w) * v == w.cross(v));
}

TEST(Vee, InvertsHat) {
  const Vector3d w(1, 2, 3);
  EXPECT_EQ(Vee(Hat(w)), w);
}

TEST(Vee, ReadsTheAntisymmetricPart) {
  Matrix3d W;
  W << 1, 2, 3, 4, 5, 6, 7, 8, 10;
  EXPECT_EQ(Vee(W), Vector3d(1, -2, 1));
  EXPECT_EQ(Vee(W + W.transpose()), Vector3d::Zero());
}

TEST(ExpSo3, QuarterTurnsAboutTheAxes) {
  Matrix3d Rx, Ry, Rz;
  Rx << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Ry << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  Rz << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LE((ExpSo3({M_PI_2, 0, 0}) - Rx).norm(), kRotationTolerance);
  EXPECT_LE((ExpSo3({0, M_PI_2, 0}) - Ry).norm(), kRotationTolerance);
  EXPECT_LE((ExpSo3({0, 0, M_PI_2}) - Rz).norm(), kRotationTolerance);
}

TEST(ExpSo3, OfZeroIsTheIdentity) {
  EXPECT_EQ(ExpSo3(Vector3d::Zero()), Matrix3d::Identity());
}

RC_GTEST_PROP(ExpSo3, IsARotation, ()) {
  const Matrix3d R = ExpSo3(*RotationVectors(4 * M_PI));
  RC_ASSERT((R * R.transpose() - Matrix3d::Identity()).norm() <=
            4 * kRotationTolerance);
  RC_ASSERT(R.determinant() > 0);
}

RC_GTEST_PROP(ExpSo3, AgreesWithAngleAxis, ()) {
  const Vector3d w = *RotationVectors(4 * M_PI);
  const Matrix3d expected =
      Eigen::AngleAxisd(w.stableNorm(), w.stableNormalized())
          .toRotationMatrix();
  // AngleAxis amplifies the rounding of the angle by up to 4 π.
  RC_ASSERT((ExpSo3(w) - expected).norm() <= 4 * kRotationTolerance);
}

RC_GTEST_PROP(ExpSo3, TurnsOnePlaneAtATime, ()) {
  const Vector3d w = *RotationVectors(M_PI);
  const double t = *Numbers(1);
  // exp(t w) is a one-parameter subgroup.
  RC_ASSERT((ExpSo3(t * w) * ExpSo3((1 - t) * w) - ExpSo3(w)).norm() <=
            4 * kRotationTolerance);
  // The axis is invariant.
  RC_ASSERT((ExpSo3(w) * w - w).norm() <= kRotationTolerance * w.norm());
}

RC_GTEST_PROP(ExpSo3, TurnsWithItsArgument, ()) {
  const Vector3d w = *RotationVectors(M_PI);
  const Matrix3d R = *Rotations();
  RC_ASSERT((R * ExpSo3(w) * R.transpose() - ExpSo3(R * w)).norm() <=
            4 * kRotationTolerance);
}

TEST(ExpSo3, NotFiniteGivesNan) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e160}) {
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Vector3d w(1, 2, 3);
      w[i] = bad;
      EXPECT_TRUE(ExpSo3(w).array().isNaN().all());
      EXPECT_TRUE(ExpQuaternion(w).coeffs().array().isNaN().all());
    }
  }
}

RC_GTEST_PROP(LogSo3, InvertsExp, ()) {
  const Vector3d w = *RotationVectors(M_PI);
  const Vector3d log = LogSo3(ExpSo3(w));
  const double tolerance = 4 * kRotationTolerance;
  // At π the opposite vector is correct too.
  RC_ASSERT((log - w).norm() <= tolerance * w.norm() ||
            (w.norm() > M_PI - 1e-15 && (log + w).norm() <= tolerance));
}

RC_GTEST_PROP(LogSo3, IsTheShortestRotationVector, ()) {
  const Vector3d w = *RotationVectors(4 * M_PI);
  const Matrix3d R = ExpSo3(w);
  const Vector3d log = LogSo3(R);
  RC_ASSERT(log.norm() <= M_PI * (1 + kRotationTolerance));
  RC_ASSERT((ExpSo3(log) - R).norm() <= 4 * kRotationTolerance);
}

TEST(LogSo3, HalfTurns) {
  for (const Vector3d& axis :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1),
        Vector3d(0.6, 0.8, 0), Vector3d(0, 0.6, -0.8), Vector3d(-0.6, 0, 0.8),
        (Vector3d(2, -1, 2) / 3).eval()}) {
    SCOPED_TRACE(axis.transpose());
    // A rotation by exactly π is symmetric.
    const Matrix3d R = 2 * axis * axis.transpose() - Matrix3d::Identity();
    const Vector3d w = LogSo3(R);
    EXPECT_NEAR(w.norm(), M_PI, Rounding(M_PI, 1));
    EXPECT_LE(w.cross(axis).norm(), Rounding(M_PI, 3));
  }
}

TEST(LogSo3, KeepsItsSignJustBelowAHalfTurn) {
  for (const Vector3d& axis :
       {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, 1),
        (Vector3d(-2, 1, -2) / 3).eval()}) {
    SCOPED_TRACE(axis.transpose());
    const Vector3d w = (M_PI - 1e-9) * axis;
    EXPECT_LE((LogSo3(ExpSo3(w)) - w).norm(), Rounding(M_PI, 3));
  }
}

TEST(LogSo3, NotFiniteGivesNan) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int i = 0; i < 9; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Matrix3d R = ExpSo3({1, 2, 3});
      R(i / 3, i % 3) = bad;
      EXPECT_TRUE(LogSo3(R).array().isNaN().all());
      EXPECT_TRUE(QuaternionFromMatrix(R).coeffs().array().isNaN().all());
      EXPECT_TRUE(ProjectToSo3(R).array().isNaN().all());
    }
  }
}

RC_GTEST_PROP(InterpolateSo3, GoesFromOneEndToTheOther, ()) {
  const Matrix3d R_0 = *Rotations(), R_1 = *Rotations();
  const double tolerance = 4 * kRotationTolerance;
  RC_ASSERT((InterpolateSo3(R_0, R_1, 0) - R_0).norm() <= tolerance);
  RC_ASSERT((InterpolateSo3(R_0, R_1, 1) - R_1).norm() <= tolerance);
}

RC_GTEST_PROP(InterpolateSo3, TurnsEvenly, ()) {
  const Matrix3d R_0 = *Rotations();
  const Vector3d w = *RotationVectors(3);
  const double t = *Numbers(1);
  const Matrix3d R_1 = R_0 * ExpSo3(w);
  RC_ASSERT((InterpolateSo3(R_0, R_1, t) - R_0 * ExpSo3(t * w)).norm() <=
            4 * kRotationTolerance);
}

RC_GTEST_PROP(ProjectToSo3, LeavesRotationsAlone, ()) {
  const Matrix3d R = *Rotations();
  RC_ASSERT((ProjectToSo3(R) - R).norm() <= 4 * kRotationTolerance);
}

// R is the rotation nearest to A if R'A is symmetric and each two of its
// eigenvalues have a positive sum.
RC_GTEST_PROP(ProjectToSo3, IsTheNearestRotation, ()) {
  const Matrix3d R = *Rotations();
  const Vector3d a = *Vectors(), b = *Vectors(), c = *Vectors();
  Matrix3d A;
  A << a, b, c;
  A = R + A / 100;
  const Matrix3d P = ProjectToSo3(A);
  RC_ASSERT((P * P.transpose() - Matrix3d::Identity()).norm() <=
            4 * kRotationTolerance);
  RC_ASSERT(P.determinant() > 0);
  RC_ASSERT(Vee(P.transpose() * A).norm() <= 4 * kRotationTolerance);
  const Vector3d step = *RotationVectors(3);
  RC_ASSERT((P - A).norm() <=
            (P * ExpSo3(step) - A).norm() + kRotationTolerance);
}

TEST(ProjectToSo3, OfAReflectionIsARotation) {
  // The smallest singular value changes its sign, at any position.
  const Matrix3d A = Vector3d(-0.5, 1, 2).asDiagonal();
  EXPECT_LE((ProjectToSo3(A) - Matrix3d::Identity()).norm(),
            kRotationTolerance);
  const Matrix3d B = Vector3d(1, -2, 0.5).asDiagonal();
  const Matrix3d expected = Vector3d(1, -1, -1).asDiagonal();
  EXPECT_LE((ProjectToSo3(B) - expected).norm(), kRotationTolerance);
}

TEST(So3, AllocatesNothing) {
  const Vector3d w(0.1, -0.2, 0.3);
  const Matrix3d R = ExpSo3(w);
  CountMalloc count;
  const Vector3d log = LogSo3(ExpSo3(9 * w) * R);
  const Matrix3d S = ProjectToSo3(InterpolateSo3(R, ExpSo3(log), 0.5));
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_GT(S.trace(), 0);
}

TEST(So3, ThrowsNothing) {
  const Vector3d w(1, 2, 3);
  const Matrix3d R = ExpSo3(w);
  static_assert(noexcept(Hat(w))&& noexcept(Vee(R)));
  static_assert(noexcept(ExpSo3(w))&& noexcept(LogSo3(R)));
  static_assert(noexcept(InterpolateSo3(R, R, 0))&& noexcept(ProjectToSo3(R)));
}

}  // namespace
}  // namespace poise
