// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/closest_points.h"

#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Vector3d;

constexpr double kSoftness = 0.01;

// A capsule with ends in a box of 1 m. Some are points, and coordinates that
// are multiples of 1/4 make parallel and touching segments frequent.
Capsule AnyCapsule() {
  const auto end = [] {
    const double unit = *rc::gen::element(0.25, 0.001);
    const int most = static_cast<int>(1 / unit);
    Vector3d p;
    for (double& x : p) x = unit * *rc::gen::inRange(-most, most + 1);
    return p;
  };
  Capsule capsule{end(), end(), 0.001 * *rc::gen::inRange(1, 300)};
  if (*rc::gen::inRange(0, 8) == 0) capsule.end = capsule.start;
  return capsule;
}

// Distance of two capsules by sampling one segment. The distance of a point to
// the other segment is a closed form with one clamp.
double SampledDistance(const Capsule& A, const Capsule& B, int samples) {
  const Vector3d w = B.end - B.start;
  double least = INFINITY;
  for (int i = 0; i <= samples; ++i) {
    const Vector3d p = A.start + (A.end - A.start) * i / samples;
    const double length = w.squaredNorm();
    const double t =
        length > 0 ? std::clamp(w.dot(p - B.start) / length, 0.0, 1.0) : 0;
    least = std::min(least, (p - B.start - t * w).norm());
  }
  return least - A.radius - B.radius;
}

RC_GTEST_PROP(ClosestPoints, AgreeWithSampling, ()) {
  const Capsule A = AnyCapsule(), B = AnyCapsule();
  const ClosestPoints closest = ComputeClosestPoints(A, B, 0);
  constexpr int kSamples = 500;
  const double sampled = SampledDistance(A, B, kSamples);
  // The nearest sample is at most half a step away from the closest point.
  const double step = (A.end - A.start).norm() / kSamples / 2;
  RC_ASSERT(closest.distance <= sampled + Rounding(4, 10));
  RC_ASSERT(closest.distance >= sampled - step - Rounding(4, 10));
  const double apart = (closest.p_A - closest.p_B).norm();
  RC_ASSERT(std::abs(apart - A.radius - B.radius - closest.distance) <=
            Rounding(4, 10));
}

// FCL moves a capsule along z; it knows no capsule of length 0.
fcl::Transform3d PoseOfCapsule(const Capsule& capsule) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(),
                                                  capsule.end - capsule.start)
                   .toRotationMatrix();
  X.translation() = (capsule.start + capsule.end) / 2;
  return X;
}

RC_GTEST_PROP(ClosestPoints, HaveTheDistanceOfFcl, ()) {
  const Capsule A = AnyCapsule(), B = AnyCapsule();
  const double a = (A.end - A.start).norm(), b = (B.end - B.start).norm();
  RC_PRE(a > 0 && b > 0);
  const fcl::Capsuled shape_a(A.radius, a), shape_b(B.radius, b);
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::DistanceResultd result;
  fcl::distance(&shape_a, PoseOfCapsule(A), &shape_b, PoseOfCapsule(B), request,
                result);
  const double distance = ComputeClosestPoints(A, B, 0).distance;
  if (distance <= 0) {
    // FCL does not measure how deep capsules overlap.
    RC_ASSERT(result.min_distance <= 1e-6);
  } else {
    // FCL iterates to a tolerance of 1e-6.
    RC_ASSERT(std::abs(result.min_distance - distance) <= 1e-5);
  }
}

RC_GTEST_PROP(ClosestPoints, AreSymmetricInTheCapsules, (bool is_soft)) {
  const Capsule A = AnyCapsule(), B = AnyCapsule();
  const double softness = is_soft ? kSoftness : 0;
  const ClosestPoints ab = ComputeClosestPoints(A, B, softness);
  const ClosestPoints ba = ComputeClosestPoints(B, A, softness);
  // A nearly singular system has points of half the digits, but the distance is
  // stationary there.
  RC_ASSERT(std::abs(ab.distance - ba.distance) <= 1e-9);
}

RC_GTEST_PROP(ClosestPoints, SoftDistanceIsAtMostALittleSmaller, ()) {
  const Capsule A = AnyCapsule(), B = AnyCapsule();
  const double radii = A.radius + B.radius;
  const double exact = ComputeClosestPoints(A, B, 0).distance + radii;
  const double soft = ComputeClosestPoints(A, B, kSoftness).distance + radii;
  const double ends =
      (A.end - A.start).squaredNorm() + (B.end - B.start).squaredNorm();
  // Where the segments cross, D is bounded from below by half of |x|.
  const double most = std::hypot(exact, std::sqrt(kSoftness * ends / 4)) / 2;
  RC_ASSERT(soft <= std::max(exact, most) + Rounding(4, 10));
  RC_ASSERT(soft * soft >=
            std::min(exact * exact - kSoftness * ends / 4, exact * exact / 4) -
                Rounding(16, 10));
}

RC_GTEST_PROP(ClosestPoints, GradientIsTheDerivativeOfTheSoftDistance, ()) {
  const Capsule A = AnyCapsule();
  Capsule B = AnyCapsule();
  // The capsules' segments are at least 0.5 m apart.
  B.start.x() += 2.5;
  B.end.x() += 2.5;
  const Vector3d v = *Vectors(), w = *Vectors();
  // A moves and turns; its length stays.
  const auto distance = [&](double t) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.1 * t * w.norm(),
                          w.isZero() ? Vector3d::UnitX() : w.normalized())
            .toRotationMatrix();
    const Capsule moved{R * A.start + 0.1 * t * v, R * A.end + 0.1 * t * v,
                        A.radius};
    return ComputeClosestPoints(moved, B, kSoftness);
  };
  const ClosestPoints now = distance(0);
  const double rate = now.gradient.dot(0.1 * v + (0.1 * w).cross(now.p_A));
  // The first derivative has kinks where a point reaches an end; the second one
  // is at most |V|^2 (1 / D + L / softness) there, times the step.
  constexpr double kStep = 1e-6;
  const double numeric =
      (distance(kStep).distance - distance(-kStep).distance) / (2 * kStep);
  const double speed = 0.1 * (v.norm() + 2 * w.norm());
  RC_ASSERT(std::abs(rate - numeric) <= kStep * speed * speed * 1000 + 1e-9);
}

TEST(ClosestPoints, MoveContinuouslyThroughParallel) {
  const Capsule A{{-0.15, 0, 0}, {0.15, 0, 0}, 0.04};
  Vector3d last = Vector3d::Zero();
  constexpr double kStep = 1e-4;  // rad.
  for (double angle = -0.05; angle < 0.05; angle += kStep) {
    const Vector3d half(0.15 * std::cos(angle), 0, 0.15 * std::sin(angle));
    const Vector3d up(0, 0, 0.1);
    const ClosestPoints closest =
        ComputeClosestPoints(A, {up - half, up + half, 0.04}, kSoftness);
    // From end to end, 0.3 m, within about 0.1 rad.
    if (angle > -0.05) {
      EXPECT_LT((closest.p_A - last).norm(), 30 * kStep);
    }
    last = closest.p_A;
  }
  EXPECT_NEAR(last.x(), -0.15, 0.01);
}

TEST(ClosestPoints, HaveNoGradientWhereSegmentsCross) {
  const Capsule A{{-1, 0, 0}, {1, 0, 0}, 0.1}, B{{0, -1, 0}, {0, 1, 0}, 0.2};
  for (const double softness : {0.0, kSoftness}) {
    const ClosestPoints closest = ComputeClosestPoints(A, B, softness);
    EXPECT_NEAR(closest.distance, -0.3, 1e-12);
    EXPECT_TRUE(closest.gradient.isZero());
  }
}

TEST(ClosestPoints, DoNotAllocate) {
  const Capsule A{{0, 0, 0}, {1, 0, 0}, 0.1}, B{{0, 1, 0}, {1, 1, 1}, 0.1};
  const CountMalloc count;
  const ClosestPoints closest = ComputeClosestPoints(A, B, kSoftness);
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_GT(closest.distance, 0);
}

}  // namespace
}  // namespace poise
