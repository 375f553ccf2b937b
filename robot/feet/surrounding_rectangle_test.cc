// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/surrounding_rectangle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace poise {
namespace {

using Eigen::Vector2d;

// Rounding of a rotation of lengths below 1 m.
constexpr double kRounding = 1e-12;

std::vector<Vector2d> TurnedSole(double angle, const Vector2d& center) {
  std::vector<Vector2d> corners;
  for (const Vector2d& corner : {Vector2d(-0.1, -0.05), Vector2d(0.1, -0.05),
                                 Vector2d(0.1, 0.05), Vector2d(-0.1, 0.05)}) {
    corners.emplace_back(center + Eigen::Rotation2Dd(angle) * corner);
  }
  return corners;
}

TEST(SurroundingRectangle, FindsTheSizeOfATurnedSole) {
  const Vector2d center(0.03, -0.01);
  for (const double angle : {-0.7, -0.5, -0.1, 0., 0.2, 0.5, 0.78}) {
    const auto r = SurroundingRectangle(TurnedSole(angle, center));
    EXPECT_NEAR(r.angle, angle, kRounding);
    EXPECT_LT((r.center - center).norm(), kRounding);
    EXPECT_LT((r.half_size - Vector2d(0.1, 0.05)).norm(), kRounding);
  }
}

// A sole turned by more than pi/4 is named by the side that is nearest to x.
TEST(SurroundingRectangle, KeepsTheAngleBelowAnEighthOfATurn) {
  const auto r = SurroundingRectangle(TurnedSole(1, {0, 0}));
  EXPECT_NEAR(r.angle, 1 - M_PI / 2, kRounding);
  EXPECT_LT((r.half_size - Vector2d(0.05, 0.1)).norm(), kRounding);
}

// The smallest rectangle around this sole is turned by 0.1 rad, because one of
// its long sides is. Its area is only a little smaller.
TEST(SurroundingRectangle, PrefersTheDirectionOfX) {
  const auto r = SurroundingRectangle(
      {{-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {0, 0.055}, {-0.1, 0.05}});
  EXPECT_EQ(r.angle, 0);
  EXPECT_LT((r.half_size - Vector2d(0.1, 0.0525)).norm(), kRounding);
}

// The rectangle contains the polygon, and no other angle has a much smaller
// one.
TEST(SurroundingRectangle, IsTheSmallestUpToATenth) {
  std::srand(1);
  for (int run = 0; run < 100; ++run) {
    std::vector<Vector2d> triangle;
    for (int i = 0; i < 3; ++i) triangle.emplace_back(Vector2d::Random());
    const auto r = SurroundingRectangle(triangle);
    for (const Vector2d& corner : triangle) {
      const Vector2d p =
          Eigen::Rotation2Dd(-r.angle) * Vector2d(corner - r.center);
      EXPECT_TRUE(
          (p.cwiseAbs().array() <= r.half_size.array() + kRounding).all());
    }
    for (double angle = 0; angle < M_PI / 2; angle += 0.01) {
      Eigen::AlignedBox2d box;
      for (const Vector2d& corner : triangle) {
        box.extend(Eigen::Rotation2Dd(angle) * corner);
      }
      EXPECT_LT(0.9 * r.half_size.prod(),
                0.25 * box.sizes().prod() + kRounding);
    }
  }
}

}  // namespace
}  // namespace poise
