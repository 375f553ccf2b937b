// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/se3.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "poise/math/pose.h"
#include "poise/math/so3.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Rounding of positions up to 10 m after a few rotations.
const double kTolerance = Rounding(10, 16);

double Distance(const Pose& X, const Pose& Y) {
  return (X.R - Y.R).norm() + (X.p - Y.p).norm();
}

rc::Gen<Vector6d> Twists(double max_angle) {
  return rc::gen::map(rc::gen::pair(RotationVectors(max_angle), Vectors()),
                      [](const std::pair<Vector3d, Vector3d>& x) -> Vector6d {
                        return (Vector6d() << x.first, x.second).finished();
                      });
}

Eigen::Matrix4d Homogeneous(const Pose& X) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = X.R;
  T.topRightCorner<3, 1>() = X.p;
  return T;
}

RC_GTEST_PROP(Pose, ComposesAsMatricesDo, ()) {
  const Pose X = *Poses(), Y = *Poses();
  RC_ASSERT((Homogeneous(X * Y) - Homogeneous(X) * Homogeneous(Y)).norm() <=
            kTolerance);
}

RC_GTEST_PROP(Pose, ActsAsMatricesDo, ()) {
  const Pose X = *Poses();
  const Vector3d p = *Vectors();
  const Eigen::Vector4d expected = Homogeneous(X) * p.homogeneous();
  RC_ASSERT((X * p - expected.head<3>()).norm() <= kTolerance);
}

RC_GTEST_PROP(Pose, InverseUndoes, ()) {
  const Pose X = *Poses();
  RC_ASSERT(Distance(X * X.Inverse(), Pose()) <= kTolerance);
  RC_ASSERT(Distance(X.Inverse() * X, Pose()) <= kTolerance);
}

RC_GTEST_PROP(Pose, ComposingIsAssociative, ()) {
  const Pose X = *Poses(), Y = *Poses(), Z = *Poses();
  RC_ASSERT(Distance((X * Y) * Z, X * (Y * Z)) <= 4 * kTolerance);
  RC_ASSERT(Distance(X * Pose(), X) == 0);
  RC_ASSERT(Distance(Pose() * X, X) == 0);
}

TEST(HatSe3, HasTheEntriesOfATwist) {
  Eigen::Matrix4d expected;
  expected << 0, -3, 2, 4, 3, 0, -1, 5, -2, 1, 0, 6, 0, 0, 0, 0;
  const Vector6d x = (Vector6d() << 1, 2, 3, 4, 5, 6).finished();
  EXPECT_EQ(HatSe3(x), expected);
  EXPECT_EQ(VeeSe3(expected), x);
  EXPECT_EQ(VeeSe3(expected + Eigen::Matrix4d::Identity()), x);
}

RC_GTEST_PROP(VeeSe3, InvertsHat, ()) {
  const Vector6d x = *Twists(3);
  RC_ASSERT(VeeSe3(HatSe3(x)) == x);
}

TEST(ExpSe3, OfAPureTranslationIsATranslation) {
  const Pose X = ExpSe3((Vector6d() << 0, 0, 0, 4, 5, 6).finished());
  EXPECT_EQ(X.R, Matrix3d::Identity());
  EXPECT_EQ(X.p, Vector3d(4, 5, 6));
}

TEST(ExpSe3, OfARotationAboutADistantAxis) {
  // A rotation by 90 degrees about the vertical axis through (1, 0, 0).
  const Vector3d w(0, 0, M_PI_2);
  const Pose X =
      ExpSe3((Vector6d() << w, -w.cross(Vector3d(1, 0, 0))).finished());
  EXPECT_LE((X.p - Vector3d(1, -1, 0)).norm(), kTolerance);
  EXPECT_LE((X * Vector3d(1, 0, 7) - Vector3d(1, 0, 7)).norm(), kTolerance);
}

TEST(ExpSe3, OfNearlyAFullTurnIsExactAcrossTheAxis) {
  // The double below 2 π has an error of 2.4e-16, and so has the chord of the
  // circle.
  const double angle = 2 * M_PI;
  const Pose X = ExpSe3((Vector6d() << 0, 0, angle, 3, 0, 0).finished());
  const double off = std::sin(angle);  // -2.4e-16.
  EXPECT_NEAR(X.p.x(), 3 * off / angle, 1e-15 * std::abs(off));
  EXPECT_NEAR(X.p.y(), 3 * off * off / 2 / angle, 1e-15 * off * off);
  EXPECT_EQ(X.p.z(), 0);
}

// Compares with repeated squaring of (I + A/2^n + ...), an independent
// algorithm.
RC_GTEST_PROP(ExpSe3, IsTheMatrixExponential, ()) {
  const Vector6d x = *Twists(4 * M_PI);
  const Eigen::Matrix4d A = HatSe3(x) / 64;
  Eigen::Matrix4d E = Eigen::Matrix4d::Identity();
  for (int n = 18; n > 0; --n) {
    E = (Eigen::Matrix4d::Identity() + A * E / n).eval();
  }
  for (int i = 0; i < 6; ++i) E = (E * E).eval();
  // Six squarings double the error six times.
  RC_ASSERT((Homogeneous(ExpSe3(x)) - E).norm() <= 64 * kTolerance);
}

RC_GTEST_PROP(LogSe3, InvertsExp, ()) {
  const Vector6d x = *Twists(M_PI - 1e-9);
  RC_ASSERT((LogSe3(ExpSe3(x)) - x).norm() <= 4 * kTolerance);
}

RC_GTEST_PROP(ExpSe3, InvertsLog, ()) {
  const Pose X = *Poses();
  RC_ASSERT(Distance(ExpSe3(LogSe3(X)), X) <= 4 * kTolerance);
}

RC_GTEST_PROP(Adjoint, IsTheConjugationOfTwists, ()) {
  const Pose X = *Poses();
  const Vector6d x = *Twists(M_PI);
  const Eigen::Matrix4d conjugated =
      Homogeneous(X) * HatSe3(x) * Homogeneous(X.Inverse());
  RC_ASSERT((HatSe3(Adjoint(X) * x) - conjugated).norm() <= 20 * kTolerance);
}

RC_GTEST_PROP(Adjoint, IsAHomomorphism, ()) {
  const Pose X = *Poses(), Y = *Poses();
  RC_ASSERT((Adjoint(X * Y) - Adjoint(X) * Adjoint(Y)).norm() <=
            4 * kTolerance);
  RC_ASSERT((Adjoint(X.Inverse()) * Adjoint(X) - Matrix6d::Identity()).norm() <=
            4 * kTolerance);
}

RC_GTEST_PROP(DualAdjoint, IsTheTransposedInverse, ()) {
  const Pose X = *Poses();
  RC_ASSERT((DualAdjoint(X) - Adjoint(X.Inverse()).transpose()).norm() <=
            kTolerance);
}

RC_GTEST_PROP(InterpolateSe3, GoesFromOneEndToTheOther, ()) {
  const Pose X_0 = *Poses(), X_1 = *Poses();
  RC_ASSERT(Distance(InterpolateSe3(X_0, X_1, 0), X_0) <= 4 * kTolerance);
  RC_ASSERT(Distance(InterpolateSe3(X_0, X_1, 1), X_1) <= 8 * kTolerance);
}

RC_GTEST_PROP(InterpolateSe3, FollowsTheScrew, ()) {
  const Pose X_0 = *Poses();
  const Vector6d x = *Twists(3);
  const double t = *Numbers(1);
  RC_ASSERT(Distance(InterpolateSe3(X_0, X_0 * ExpSe3(x), t),
                     X_0 * ExpSe3(t * x)) <= 16 * kTolerance);
}

TEST(ExpSe3, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Vector6d x = (Vector6d() << 1, 2, 3, 4, 5, 6).finished();
      x[i] = bad;
      EXPECT_TRUE(ExpSe3(x).R.array().isNaN().all());
      EXPECT_TRUE(ExpSe3(x).p.array().isNaN().all());
      x = (Vector6d() << 1, 2, 3, 4, 5, 6).finished();
      x[3 + i] = bad;
      EXPECT_TRUE(ExpSe3(x).p.array().isNaN().all());
    }
  }
}

TEST(LogSe3, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 9; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Pose X{ExpSo3({1, 2, 3}), {4, 5, 6}};
      X.R(i / 3, i % 3) = bad;
      EXPECT_TRUE(LogSe3(X).array().isNaN().all());
      X = {ExpSo3({1, 2, 3}), {4, 5, 6}};
      X.p[i % 3] = bad;
      EXPECT_TRUE(LogSe3(X).tail<3>().array().isNaN().all());
    }
  }
}

TEST(Se3, AllocatesAndThrowsNothing) {
  const Vector6d x = (Vector6d() << 1, 2, 3, 4, 5, 6).finished();
  CountMalloc count;
  const Pose X = ExpSe3(x);
  const Vector6d y =
      Adjoint(X) * LogSe3(X * X.Inverse()) + DualAdjoint(X) * VeeSe3(HatSe3(x));
  const Pose Y = InterpolateSe3(X, X, 0.5);
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_GT(y.norm() + Y.p.norm(), 0);
  static_assert(noexcept(ExpSe3(x))&& noexcept(LogSe3(X))&& noexcept(X * X));
  static_assert(noexcept(Adjoint(X))&& noexcept(DualAdjoint(X)));
  static_assert(noexcept(InterpolateSe3(X, X, 0))&& noexcept(X.Inverse()));
}

}  // namespace
}  // namespace poise
