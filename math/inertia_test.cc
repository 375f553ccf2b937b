// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/inertia.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "poise/math/se3.h"
#include "poise/math/so3.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Rounding for masses to 10 kg within 20 m at 200 m/s.
const double kTolerance = Rounding(1e5, 8);

struct Particle {
  double mass;
  Vector3d p;  // From the body's origin.
};

// Returns the inertia of particles from its definition.
Inertia Assemble(const std::vector<Particle>& particles) {
  Inertia M;
  for (const Particle& particle : particles) {
    M.mass += particle.mass;
    M.p_BoG_B += particle.mass * particle.p;
  }
  M.p_BoG_B /= M.mass;
  for (const Particle& particle : particles) {
    const Matrix3d P = Hat(particle.p - M.p_BoG_B);
    M.I_G_B -= particle.mass * P * P;
  }
  return M;
}

rc::Gen<std::vector<Particle>> Particles() {
  return rc::gen::nonEmpty(rc::gen::container<std::vector<Particle>>(
      rc::gen::map(rc::gen::pair(rc::gen::inRange(1, 100), Vectors()),
                   [](const std::pair<int, Vector3d>& x) -> Particle {
                     return {x.first / 100.0, x.second};
                   })));
}

// Returns the expected rounding of a sum over particles.
double ToleranceFor(const std::vector<Particle>& particles) {
  return Rounding(4000, 8 * static_cast<int>(particles.size()));
}

bool IsNear(const Inertia& M_1, const Inertia& M_2, double tolerance) {
  return std::abs(M_1.mass - M_2.mass) <= tolerance &&
         (M_1.p_BoG_B - M_2.p_BoG_B).norm() <= tolerance &&
         (M_1.I_G_B - M_2.I_G_B).norm() <= tolerance;
}

RC_GTEST_PROP(Inertia, AddsAsItsParticlesDo, ()) {
  std::vector<Particle> first = *Particles();
  const std::vector<Particle> second = *Particles();
  const Inertia sum = Assemble(first) + Assemble(second);
  first.insert(first.end(), second.begin(), second.end());
  RC_ASSERT(IsNear(sum, Assemble(first), ToleranceFor(first)));
}

RC_GTEST_PROP(Inertia, MovesAsItsParticlesDo, ()) {
  const std::vector<Particle> particles = *Particles();
  const Pose X_AB = *Poses();
  std::vector<Particle> moved, turned, shifted;
  for (const Particle& particle : particles) {
    moved.push_back({particle.mass, X_AB * particle.p});
    turned.push_back({particle.mass, X_AB.R * particle.p});
    shifted.push_back({particle.mass, particle.p - X_AB.p});
  }
  const double tolerance = ToleranceFor(particles);
  const Inertia M = Assemble(particles);
  RC_ASSERT(IsNear(X_AB * M, Assemble(moved), tolerance));
  RC_ASSERT(IsNear(X_AB.R * M, Assemble(turned), tolerance));
  RC_ASSERT(IsNear(Shift(M, X_AB.p), Assemble(shifted), tolerance));
}

RC_GTEST_PROP(Inertia, HasTheMomentumOfItsParticles, ()) {
  const std::vector<Particle> particles = *Particles();
  const SpatialMotion V = *Motions();
  SpatialMomentum L;
  double energy = 0;
  for (const Particle& particle : particles) {
    const Vector3d v = Shift(V, particle.p).linear;
    L = L + Shift(SpatialMomentum(Vector3d::Zero(), particle.mass * v),
                  -particle.p);
    energy += 0.5 * particle.mass * v.squaredNorm();
  }
  const Inertia M = Assemble(particles);
  const double tolerance = 200 * ToleranceFor(particles);
  RC_ASSERT(((M * V).vector() - L.vector()).norm() <= tolerance);
  RC_ASSERT(std::abs(KineticEnergy(M, V) - energy) <= 20 * tolerance);
}

// By Newton and Euler, the force on a body is the sum of the forces on its
// particles.
RC_GTEST_PROP(Inertia, TakesTheForceOfItsParticles, ()) {
  const std::vector<Particle> particles = *Particles();
  const SpatialMotion V = *Motions();
  const SpatialAcceleration A(*Vectors(), *Vectors());
  SpatialForce F;
  for (const Particle& particle : particles) {
    const Vector3d a = Shift(A, V, particle.p).linear;
    F = F +
        Shift(SpatialForce(Vector3d::Zero(), particle.mass * a), -particle.p);
  }
  const Inertia M = Assemble(particles);
  const SpatialMotion W(V.angular, Vector3d::Zero());
  const SpatialForce expected = M * A + Cross(W, M * W);
  RC_ASSERT((F.vector() - expected.vector()).norm() <=
            1000 * ToleranceFor(particles));
}

RC_GTEST_PROP(Inertia, StaysSymmetricToTheBitInAnyFrame, ()) {
  const Inertia M_B = *Inertias();
  const Matrix3d I_A = (*Poses() * M_B).I_G_B;
  RC_ASSERT(I_A == I_A.transpose());
  const Matrix3d I_sum = (*Rotations() * M_B + M_B).I_G_B;
  RC_ASSERT(I_sum == I_sum.transpose());
}

RC_GTEST_PROP(Inertia, MatrixIsItsAction, ()) {
  const Inertia M = *Inertias();
  const SpatialMotion V = *Motions();
  const Matrix6d matrix = Matrix6FromInertia(M);
  RC_ASSERT(matrix == matrix.transpose());
  RC_ASSERT((matrix * V.vector() - (M * V).vector()).norm() <= kTolerance);
  RC_ASSERT(std::abs(V.vector().dot(matrix * V.vector()) -
                     2 * KineticEnergy(M, V)) <= 100 * kTolerance);
  RC_ASSERT(std::abs(Dot(V, M * V) - 2 * KineticEnergy(M, V)) <=
            100 * kTolerance);
}

// Rounding errors of a rotation must not make a mass matrix unsymmetric.
TEST(Inertia, MatrixIsSymmetricToTheBit) {
  Inertia M{2, {0.1, 0.2, 0.3}, Matrix3d::Identity()};
  M.I_G_B(0, 1) = 0.1;
  M.I_G_B(1, 0) = std::nextafter(0.1, 1);
  const Matrix6d matrix = Matrix6FromInertia(M);
  EXPECT_EQ(matrix, Matrix6d(matrix.transpose()));
}

RC_GTEST_PROP(Inertia, MatrixMovesByTheDualAdjoint, ()) {
  const Inertia M = *Inertias();
  const Pose X = *Poses();
  const Matrix6d Ad = DualAdjoint(X);
  RC_ASSERT(
      (Matrix6FromInertia(X * M) - Ad * Matrix6FromInertia(M) * Ad.transpose())
          .norm() <= kTolerance);
}

RC_GTEST_PROP(Inertia, EnergyIsTheSameInAllFrames, ()) {
  const Inertia M = *Inertias();
  const SpatialMotion V = *Motions();
  const Pose X = *Poses();
  RC_ASSERT(std::abs(KineticEnergy(X * M, X * V) - KineticEnergy(M, V)) <=
            100 * kTolerance);
}

TEST(Inertia, SumOfMasslessBodiesIsFinite) {
  const Inertia sum = Inertia{0, {1, 2, 3}, Matrix3d::Identity()} +
                      Inertia{0, {3, 2, 1}, Matrix3d::Identity()};
  EXPECT_EQ(sum.mass, 0);
  EXPECT_EQ(sum.p_BoG_B, Vector3d(1, 2, 3));
  EXPECT_EQ(sum.I_G_B, 2 * Matrix3d::Identity());
}

TEST(Inertia, SumOfTwoMassesHasTheReducedMassBetweenThem) {
  const Inertia sum = Inertia{3, {0, 0, 0}, Matrix3d::Zero()} +
                      Inertia{1, {4, 0, 0}, Matrix3d::Zero()};
  EXPECT_EQ(sum.mass, 4);
  EXPECT_EQ(sum.p_BoG_B, Vector3d(1, 0, 0));
  const Matrix3d expected = Vector3d(0, 12, 12).asDiagonal();
  EXPECT_EQ(sum.I_G_B, expected);
}

// Viète's formulas: the moments are the roots of det(I - x 1).
RC_GTEST_PROP(PrincipalMoments, AreTheRootsOfTheCharacteristicPolynomial, ()) {
  const Matrix3d I = (*Inertias()).I_G_B;
  const Vector3d x = PrincipalMoments(I);
  const double scale = I.norm();
  const double minors = (std::pow(I.trace(), 2) - (I * I).trace()) / 2;
  RC_ASSERT(std::abs(x.sum() - I.trace()) <= Rounding(scale, 8));
  RC_ASSERT(std::abs(x[0] * x[1] + x[0] * x[2] + x[1] * x[2] - minors) <=
            Rounding(scale * scale, 16));
  RC_ASSERT(std::abs(x.prod() - I.determinant()) <=
            Rounding(scale * scale * scale, 24));
}

// The moments may be those of no body: negative, or equal.
RC_GTEST_PROP(PrincipalMoments, DoNotDependOnTheAxes, ()) {
  Vector3d moments = *Vectors();
  const Matrix3d R = *Rotations();
  const Vector3d found =
      PrincipalMoments(R * moments.asDiagonal() * R.transpose());
  std::sort(moments.begin(), moments.end());
  RC_ASSERT((found - moments).norm() <= Rounding(moments.norm(), 24));
}

TEST(PrincipalMoments, AreAscendingForABox) {
  // A box of 12 kg with the edges 3, 1 and 2 m: m / 12 (b² + c²).
  const Vector3d moments(1 + 4, 9 + 4, 9 + 1);
  const Vector3d found = PrincipalMoments(moments.asDiagonal());
  EXPECT_LE((found - Vector3d(5, 10, 13)).norm(), Rounding(13, 3));
}

TEST(PrincipalMoments, AreNanIfAnEntryIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    for (int i = 0; i < 9; ++i) {
      Matrix3d I = Matrix3d::Identity();
      I(i) = bad;
      EXPECT_TRUE(PrincipalMoments(I).array().isNaN().all()) << bad << i;
    }
  }
}

RC_GTEST_PROP(FindDefect, AcceptsAPhysicalBody, ()) {
  RC_ASSERT(FindDefect(*Inertias()) == InertiaDefect::kNone);
  const Inertia M = Assemble(*Particles());
  RC_ASSERT(FindDefect(*Rotations() * M) == InertiaDefect::kNone);
}

// Returns a body whose moment about z is wrong by a factor.
Inertia Body(double factor, const Matrix3d& R = Matrix3d::Identity()) {
  const Vector3d moments(2, 3, factor * 5);
  return {1, Vector3d::Zero(), R * moments.asDiagonal() * R.transpose()};
}

TEST(FindDefect, AllowsAThinRodAndAPoint) {
  EXPECT_EQ(FindDefect(Body(1)), InertiaDefect::kNone);
  EXPECT_EQ(FindDefect({1, {1, 2, 3}, Matrix3d::Zero()}), InertiaDefect::kNone);
}

RC_GTEST_PROP(FindDefect, FindsAViolatedTriangleInequality, ()) {
  const Matrix3d R = *Rotations();
  RC_ASSERT(FindDefect(Body(1 + 1e-12, R)) == InertiaDefect::kTriangle);
  RC_ASSERT(FindDefect(Body(1 - 1e-12, R)) == InertiaDefect::kNone);
}

TEST(FindDefect, FindsAViolatedTriangleInequalityOfEachAxis) {
  for (int i = 0; i < 3; ++i) {
    Vector3d moments(1, 1, 1);
    moments[i] = 2.5;
    EXPECT_EQ(FindDefect({1, {0, 0, 0}, moments.asDiagonal()}),
              InertiaDefect::kTriangle);
  }
}

TEST(FindDefect, FindsAMassThatIsNotPositive) {
  Inertia M = Body(1);
  M.mass = 0;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kMass);
  M.mass = -1;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kMass);
  M.mass = 1e-300;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kNone);
}

TEST(FindDefect, FindsANegativeMoment) {
  for (int i = 0; i < 3; ++i) {
    Vector3d moments(1, 1, 1);
    moments[i] = -1e-12;
    EXPECT_EQ(FindDefect({1, {0, 0, 0}, moments.asDiagonal()}),
              InertiaDefect::kNotPositive);
  }
}

TEST(FindDefect, FindsAnAsymmetry) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      Inertia M = Body(0.5);
      M.I_G_B(i, j) += 1e-12;
      EXPECT_EQ(FindDefect(M), InertiaDefect::kNotSymmetric) << i << j;
    }
  }
}

// Tests both sides of the tolerance, 16 eps of the largest entry (5).
TEST(FindDefect, AllowsSixteenRoundings) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  Inertia M{1, Vector3d::Zero(), Matrix3d::Identity()};
  M.I_G_B(0, 1) = 16 * kEps;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kNone);
  M.I_G_B(0, 1) = 17 * kEps;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kNotSymmetric);
}

TEST(FindDefect, AllowsRounding) {
  const double eps = std::numeric_limits<double>::epsilon();
  Inertia M = Body(1);
  M.I_G_B(0, 1) = 15 * eps * 5;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kNone);
  M.I_G_B(0, 1) = 18 * eps * 5;
  EXPECT_EQ(FindDefect(M), InertiaDefect::kNotSymmetric);
  EXPECT_EQ(FindDefect(Body(1 + 14 * eps)), InertiaDefect::kNone);
  EXPECT_EQ(FindDefect(Body(1 + 20 * eps)), InertiaDefect::kTriangle);
  const auto thin = [eps](double n) {
    return Inertia{1, {0, 0, 0}, Vector3d(-n * eps, 1, 1).asDiagonal()};
  };
  EXPECT_EQ(FindDefect(thin(14)), InertiaDefect::kNone);
  EXPECT_EQ(FindDefect(thin(18)), InertiaDefect::kNotPositive);
}

TEST(FindDefect, FindsNumbersThatAreNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Inertia M = Body(1);
    M.mass = bad;
    EXPECT_EQ(FindDefect(M), InertiaDefect::kNotFinite);
    for (int i = 0; i < 3; ++i) {
      M = Body(1);
      M.p_BoG_B[i] = bad;
      EXPECT_EQ(FindDefect(M), InertiaDefect::kNotFinite);
      for (int j = 0; j < 3; ++j) {
        M = Body(1);
        M.I_G_B(i, j) = bad;
        EXPECT_EQ(FindDefect(M), InertiaDefect::kNotFinite);
      }
    }
  }
}

TEST(Inertia, AllocatesAndThrowsNothing) {
  const Inertia M = Body(0.9);
  const SpatialMotion V({1, 2, 3}, {4, 5, 6});
  const Pose X{ExpSo3({1, 2, 3}), {1, 2, 3}};
  CountMalloc count;
  const double energy = KineticEnergy(X * M + M, V) + Dot(V, M * V);
  const Matrix6d matrix = Matrix6FromInertia(M);
  const Vector3d moments = PrincipalMoments(M.I_G_B);
  const InertiaDefect defect = FindDefect(M);
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_GT(energy + matrix.trace() + moments.sum(), 0);
  EXPECT_EQ(defect, InertiaDefect::kNone);
  static_assert(noexcept(KineticEnergy(M, V))&& noexcept(M * V));
  static_assert(noexcept(Matrix6FromInertia(M))&& noexcept(FindDefect(M)));
  static_assert(noexcept(PrincipalMoments(M.I_G_B)));
  static_assert(noexcept(M + M)&& noexcept(X * M)&& noexcept(X.R * M));
}

}  // namespace
}  // namespace poise
