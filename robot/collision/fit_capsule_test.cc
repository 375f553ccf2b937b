// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/fit_capsule.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "poise/robot/collision/closest_points.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// Returns by how much a ball stands out of a capsule, m.
double StandsOut(const Capsule& capsule, const Ball& ball) {
  const Capsule point{ball.center, ball.center, 0};
  const ClosestPoints closest = ComputeClosestPoints(capsule, point, 0);
  return closest.distance + ball.radius;
}

RC_GTEST_PROP(FitCapsule, ContainsAllBalls, ()) {
  const auto balls = *rc::gen::nonEmpty(
      rc::gen::container<std::vector<Ball>>(rc::gen::construct<Ball>(
          Vectors(),
          rc::gen::map(Numbers(2), [](double r) { return std::abs(r); }))));
  const Capsule capsule = FitCapsule(balls);
  for (const Ball& ball : balls) {
    // The segment's ends come from a square root of a difference.
    RC_ASSERT(StandsOut(capsule, ball) <= 1e-6);
  }
}

TEST(FitCapsule, ReturnsABallItself) {
  const Capsule capsule = FitCapsule({{{1, 2, 3}, 0.5}});
  EXPECT_NEAR((capsule.start - Vector3d(1, 2, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((capsule.end - capsule.start).norm(), 0, 1e-12);
  EXPECT_NEAR(capsule.radius, 0.5, 1e-12);
}

TEST(FitCapsule, ReturnsTheCapsuleAroundTwoEqualBalls) {
  const Capsule capsule = FitCapsule({{{0, 0, 1}, 0.1}, {{0, 0, -1}, 0.1}});
  EXPECT_NEAR((capsule.end - capsule.start).norm(), 2, 1e-12);
  EXPECT_NEAR(capsule.radius, 0.1, 1e-12);
}

// The smallest capsule around a long cylinder is about as thick as the
// cylinder.
RC_GTEST_PROP(FitCapsule, IsTightAroundALongCylinder, ()) {
  const Pose X = *Poses();
  const Capsule capsule = FitCapsule(BallsOfShape(Cylinder{0.05, 0.3}, X));
  // A ring of 12 points stands out by 3.5 %; a thicker capsule may be shorter.
  RC_ASSERT(capsule.radius >= 0.05 - Rounding(1, 10));
  RC_ASSERT(capsule.radius <= 0.05 * 1.035 * 1.09);
  RC_ASSERT((capsule.end - capsule.start).norm() <= 0.3 + Rounding(1, 10));
  const Vector3d axis = (capsule.end - capsule.start).normalized();
  RC_ASSERT(std::abs(axis.dot(X.R.col(2))) >= 1 - 1e-9);
}

RC_GTEST_PROP(FitCapsule, IsTightAroundABar, ()) {
  const Pose X = *Poses();
  const Capsule capsule = FitCapsule(BallsOfShape(Box{{0.06, 0.4, 0.08}}, X));
  RC_ASSERT(capsule.radius >=
            0.05 - Rounding(1, 10));  // Half of the diagonal of 0.06 x 0.08.
  RC_ASSERT(capsule.radius <= 0.05 * 1.09);
  RC_ASSERT((capsule.end - capsule.start).norm() <= 0.4 + Rounding(1, 10));
}

TEST(BallsOfShape, SurroundACylinder) {
  // Each point of the rim is inside the capsule around the balls.
  const Capsule capsule = FitCapsule(BallsOfShape(Cylinder{0.1, 0.02}, {}));
  for (double angle = 0; angle < 2 * M_PI; angle += 0.01) {
    const Vector3d rim(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.01);
    EXPECT_LE(StandsOut(capsule, {rim, 0}), 1e-9);
  }
}

TEST(BallsOfShape, ReturnsNoBallsForAMesh) {
  EXPECT_TRUE(BallsOfShape(Mesh{"foot.stl", {1, 1, 1}}, {}).empty());
}

TEST(FitCapsule, RejectsNoBallsAndNumbersThatAreNotFinite) {
  EXPECT_THROW(FitCapsule({}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FitCapsule({{{0, nan, 0}, 0.1}}), std::invalid_argument);
  EXPECT_THROW(FitCapsule({{{0, 0, 0}, nan}}), std::invalid_argument);
}

}  // namespace
}  // namespace poise
