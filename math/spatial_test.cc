// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/spatial.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <type_traits>

#include "poise/math/se3.h"
#include "poise/math/so3.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Rounding of products of two or three numbers up to 10.
const double kTolerance = Rounding(1000, 8);

SpatialMomentum AsMomentum(const SpatialForce& F) {
  return {F.angular, F.linear};
}

// The compiler rejects a forbidden operation, at no run-time cost.
template <typename A, typename B, typename = void>
constexpr bool kAdd = false;
template <typename A, typename B>
constexpr bool
    kAdd<A, B, std::void_t<decltype(std::declval<A>() + std::declval<B>())>> =
        true;
template <typename A, typename B, typename = void>
constexpr bool kDot = false;
template <typename A, typename B>
constexpr bool kDot<
    A, B, std::void_t<decltype(Dot(std::declval<A>(), std::declval<B>()))>> =
    true;
// Whether Shift(X) needs no velocity; an acceleration needs one.
template <typename X, typename = void>
constexpr bool kShifts = false;
template <typename X>
constexpr bool
    kShifts<X, std::void_t<decltype(Shift(std::declval<X>(), Vector3d()))>> =
        true;
template <typename X, typename = void>
constexpr bool kMoves = false;
template <typename X>
constexpr bool
    kMoves<X, std::void_t<decltype(std::declval<Pose>() * std::declval<X>())>> =
        true;

TEST(SpatialVector, KindsDoNotMix) {
  static_assert(kAdd<SpatialMotion, SpatialMotion> &&
                kAdd<SpatialForce, SpatialForce>);
  static_assert(!kAdd<SpatialMotion, SpatialForce> &&
                !kAdd<SpatialForce, SpatialMomentum>);
  static_assert(!kAdd<SpatialMotion, SpatialMomentum> &&
                !kAdd<SpatialMotion, Vector6d>);
  static_assert(kDot<SpatialMotion, SpatialForce> &&
                kDot<SpatialMotion, SpatialMomentum>);
  static_assert(!kDot<SpatialMotion, SpatialMotion> &&
                !kDot<SpatialForce, SpatialForce>);
  static_assert(!kDot<SpatialForce, SpatialMotion>);
  static_assert(kAdd<SpatialAcceleration, SpatialAcceleration> &&
                !kAdd<SpatialAcceleration, SpatialMotion>);
  static_assert(!kDot<SpatialAcceleration, SpatialForce>);
  static_assert(kShifts<SpatialMotion> && !kShifts<SpatialAcceleration>);
  static_assert(kMoves<SpatialForce> && !kMoves<SpatialAcceleration>);
  static_assert(!std::is_convertible_v<Vector6d, SpatialMotion>);
  static_assert(!std::is_convertible_v<SpatialMotion, SpatialForce>);
  static_assert(!std::is_constructible_v<SpatialMomentum, SpatialForce>);
}

TEST(SpatialVector, StoresAngularFirst) {
  const Vector6d x = (Vector6d() << 1, 2, 3, 4, 5, 6).finished();
  const SpatialForce F(x);
  EXPECT_EQ(F.angular, Vector3d(1, 2, 3));
  EXPECT_EQ(F.linear, Vector3d(4, 5, 6));
  EXPECT_EQ(F.vector(), x);
  EXPECT_EQ(SpatialMotion().vector(), Vector6d::Zero());
}

RC_GTEST_PROP(SpatialVector, AddsAsItsNumbersDo, ()) {
  const SpatialMotion x = *Motions(), y = *Motions();
  const double a = *Numbers(10);
  RC_ASSERT((x + y).vector() == x.vector() + y.vector());
  RC_ASSERT((x - y).vector() == x.vector() - y.vector());
  RC_ASSERT((-x).vector() == -x.vector());
  RC_ASSERT((a * x).vector() == a * x.vector());
}

TEST(Shift, OfAMotionIsTheVelocityOfAnotherPoint) {
  // Rotation about z at 2 rad/s: the point at x = 3 moves along y.
  const SpatialMotion V_Q =
      Shift(SpatialMotion({0, 0, 2}, {1, 0, 0}), {3, 0, 0});
  EXPECT_EQ(V_Q.angular, Vector3d(0, 0, 2));
  EXPECT_EQ(V_Q.linear, Vector3d(1, 6, 0));
}

TEST(Shift, OfAForceIsTheMomentAboutAnotherPoint) {
  // A force along y, seen from x = 3, has its arm on the other side.
  const SpatialForce F_Q = Shift(SpatialForce({1, 0, 0}, {0, 2, 0}), {3, 0, 0});
  EXPECT_EQ(F_Q.angular, Vector3d(1, 0, -6));
  EXPECT_EQ(F_Q.linear, Vector3d(0, 2, 0));
  const SpatialMomentum L_Q =
      Shift(SpatialMomentum({1, 0, 0}, {0, 2, 0}), {3, 0, 0});
  EXPECT_EQ(L_Q.angular, Vector3d(1, 0, -6));
  EXPECT_EQ(L_Q.linear, Vector3d(0, 2, 0));
}

TEST(Shift, OfAnAccelerationIsThatOfAnotherPoint) {
  // A table rotates about z at 2 rad/s and accelerates by 3 rad/s2. The point
  // at x = 3 has 9 m/s2 along y and 4 * 3 m/s2 towards the axis.
  const SpatialMotion V({0, 0, 2}, {7, 8, 9});
  const SpatialAcceleration A_Q =
      Shift(SpatialAcceleration({0, 0, 3}, {1, 0, 0}), V, {3, 0, 0});
  EXPECT_EQ(A_Q.angular, Vector3d(0, 0, 3));
  EXPECT_EQ(A_Q.linear, Vector3d(-11, 9, 0));
}

RC_GTEST_PROP(Shift, OfAnAccelerationInTwoStepsIsThatInOne, ()) {
  const SpatialAcceleration A(*Vectors(), *Vectors());
  const SpatialMotion V = *Motions();
  const Vector3d p = *Vectors(), r = *Vectors();
  const SpatialAcceleration twice = Shift(Shift(A, V, p), Shift(V, p), r);
  RC_ASSERT((twice.vector() - Shift(A, V, p + r).vector()).norm() <=
            20 * kTolerance);
}

RC_GTEST_PROP(Shift, InverseShiftUndoes, ()) {
  const Vector3d p = *Vectors(), r = *Vectors();
  const SpatialMotion V = *Motions();
  const SpatialForce F = *Forces();
  RC_ASSERT(
      (Shift(Shift(V, p), r).vector() - Shift(V, p + r).vector()).norm() <=
      kTolerance);
  RC_ASSERT((Shift(Shift(F, p), -p).vector() - F.vector()).norm() <=
            kTolerance);
}

RC_GTEST_PROP(Dot, IsTheSameAtAllPointsAndInAllFrames, ()) {
  const SpatialMotion V = *Motions();
  const SpatialForce F = *Forces();
  const Vector3d p = *Vectors();
  const Pose X = *Poses();
  const double power = Dot(V, F);
  RC_ASSERT(std::abs(power - V.vector().dot(F.vector())) <= kTolerance);
  RC_ASSERT(std::abs(Dot(Shift(V, p), Shift(F, p)) - power) <=
            100 * kTolerance);
  RC_ASSERT(std::abs(Dot(X * V, X * F) - power) <= 100 * kTolerance);
  RC_ASSERT(std::abs(Dot(V, AsMomentum(F)) - power) <= kTolerance);
}

RC_GTEST_PROP(Pose, MovesByTheAdjoints, ()) {
  const Pose X = *Poses();
  const SpatialMotion V = *Motions();
  const SpatialForce F = *Forces();
  RC_ASSERT(((X * V).vector() - Adjoint(X) * V.vector()).norm() <= kTolerance);
  RC_ASSERT(((X * F).vector() - DualAdjoint(X) * F.vector()).norm() <=
            kTolerance);
  RC_ASSERT((X * AsMomentum(F)).vector() == (X * F).vector());
  const Vector6d rotated = (X.R * V).vector();
  RC_ASSERT(rotated.head<3>() == X.R * V.angular);
  RC_ASSERT(rotated.tail<3>() == X.R * V.linear);
}

RC_GTEST_PROP(Cross, IsTheAdjointActionAndItsDual, ()) {
  const SpatialMotion V = *Motions(), y = *Motions();
  const SpatialForce F = *Forces();
  const Matrix6d ad = CrossMatrix(V);
  RC_ASSERT((Cross(V, y).vector() - ad * y.vector()).norm() <= kTolerance);
  RC_ASSERT((Cross(V, F).vector() + ad.transpose() * F.vector()).norm() <=
            kTolerance);
  RC_ASSERT(Cross(V, AsMomentum(F)).vector() == Cross(V, F).vector());
}

RC_GTEST_PROP(Cross, ObeysJacobi, ()) {
  const SpatialMotion a = *Motions(), b = *Motions(), c = *Motions();
  const SpatialMotion sum =
      Cross(a, Cross(b, c)) + Cross(b, Cross(c, a)) + Cross(c, Cross(a, b));
  RC_ASSERT(sum.vector().norm() <= 10 * kTolerance);
  RC_ASSERT(Cross(a, a).vector().norm() <= kTolerance);
}

// Compares with the rate of a vector that moves with V, by central differences.
RC_GTEST_PROP(Cross, IsTheRateOfAVectorThatMovesAlong, ()) {
  const SpatialMotion V = *Motions(), y = *Motions();
  const SpatialForce F = *Forces();
  const double h = 1e-5;  // About eps^(1/3).
  const Pose after = ExpSe3(h * V.vector()), before = ExpSe3(-h * V.vector());
  const Vector6d dy = ((after * y).vector() - (before * y).vector()) / (2 * h);
  const Vector6d dF = ((after * F).vector() - (before * F).vector()) / (2 * h);
  // The third derivative, of size |V|^3 |y|, times h² / 6, and rounding / h.
  const double tolerance = 1e-10 * (1 + std::pow(V.vector().norm(), 3)) *
                           (1 + y.vector().norm() + F.vector().norm());
  RC_ASSERT((dy - Cross(V, y).vector()).norm() <= tolerance);
  RC_ASSERT((dF - Cross(V, F).vector()).norm() <= tolerance);
}

TEST(SpatialVector, AllocatesNothing) {
  const SpatialMotion V({1, 2, 3}, {4, 5, 6});
  const SpatialForce F({1, 2, 3}, {4, 5, 6});
  const Pose X{ExpSo3({1, 2, 3}), {1, 2, 3}};
  CountMalloc count;
  const double power = Dot(X * Cross(V, V + V), X * Cross(V, F - 2 * F));
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_NE(power, 1);
}

}  // namespace
}  // namespace poise
