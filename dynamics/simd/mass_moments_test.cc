// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/simd/mass_moments.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A body of five mass points, whose moments are plain sums.
struct Points {
  std::vector<double> mass;
  std::vector<Vector3d> x;
};

Points MakePoints(std::mt19937* draw) {
  Points points;
  for (int i = 0; i < 5; ++i) {
    points.mass.push_back(1.5 + MakeRandomVector(1, draw)[0]);
    points.x.emplace_back(MakeRandomVector(3, draw));
  }
  return points;
}

Inertia MakeInertia(const Points& points) {
  Inertia M;
  for (int i = 0; i < 5; ++i) {
    M.mass += points.mass[i];
    M.p_BoG_B += points.mass[i] * points.x[i];
  }
  M.p_BoG_B /= M.mass;
  for (int i = 0; i < 5; ++i) {
    const Vector3d d = points.x[i] - M.p_BoG_B;
    M.I_G_B += points.mass[i] *
               (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  }
  return M;
}

void ExpectMoments(const MassMoments& M, const Points& points) {
  double mass = 0;
  Vector3d h = Vector3d::Zero();
  Matrix3d Sigma = Matrix3d::Zero();
  for (int i = 0; i < 5; ++i) {
    mass += points.mass[i];
    h += points.mass[i] * points.x[i];
    Sigma += points.mass[i] * points.x[i] * points.x[i].transpose();
  }
  EXPECT_NEAR(M.mass, mass, Rounding(10, 5));
  EXPECT_NEAR((ToEigen(M.h) - h).norm(), 0, Rounding(20, 5));
  EXPECT_NEAR((ToEigen(M.Sigma) - Sigma).norm(), 0, Rounding(40, 5));
}

class MassMomentsTest : public testing::Test {
 protected:
  std::mt19937 draw_{1};
  Points points_ = MakePoints(&draw_);
  MassMoments M_ = MakeMassMoments(MakeInertia(points_));
  Vector3d a_ = MakeRandomVector(3, &draw_);
  Vector3d b_ = MakeRandomVector(3, &draw_);
};

TEST_F(MassMomentsTest, AreSumsOverThePoints) { ExpectMoments(M_, points_); }

TEST_F(MassMomentsTest, RotateWithThePoints) {
  const Matrix3d R = Eigen::AngleAxisd(1.3, a_.normalized()).toRotationMatrix();
  for (Vector3d& x : points_.x) x = (R * x).eval();
  ExpectMoments(Rotate(ToMat3(R), M_), points_);
}

TEST_F(MassMomentsTest, ShiftWithThePoints) {
  for (Vector3d& x : points_.x) x += a_;
  ExpectMoments(Shift(ToVec3(a_), M_), points_);
}

TEST_F(MassMomentsTest, AddUp) {
  const MassMoments twice = M_ + M_;
  for (double& mass : points_.mass) mass *= 2;
  ExpectMoments(twice, points_);
}

TEST_F(MassMomentsTest, AccelerateAsThePointsDo) {
  const Vector3d alpha = a_, w = b_, a = MakeRandomVector(3, &draw_);
  Vector3d n = Vector3d::Zero(), f = Vector3d::Zero();
  for (int i = 0; i < 5; ++i) {
    const Vector3d& x = points_.x[i];
    const Vector3d force =
        points_.mass[i] * (a + alpha.cross(x) + w.cross(w.cross(x)));
    f += force;
    n += x.cross(force);
  }
  const Force3 F =
      Accelerate(M_, AccelerationGradient(ToVec3(alpha), ToVec3(w)), ToVec3(a));
  EXPECT_NEAR((ToEigen(F.angular) - n).norm(), 0, Rounding(60, 5));
  EXPECT_NEAR((ToEigen(F.linear) - f).norm(), 0, Rounding(60, 5));
}

TEST_F(MassMomentsTest, HaveTheMomentumOfThePoints) {
  Vector3d n = Vector3d::Zero(), f = Vector3d::Zero();
  for (int i = 0; i < 5; ++i) {
    const Vector3d momentum = points_.mass[i] * (b_ + a_.cross(points_.x[i]));
    f += momentum;
    n += points_.x[i].cross(momentum);
  }
  const Force3 L = Momentum(M_, ToVec3(a_), ToVec3(b_));
  EXPECT_NEAR((ToEigen(L.angular) - n).norm(), 0, Rounding(40, 5));
  EXPECT_NEAR((ToEigen(L.linear) - f).norm(), 0, Rounding(40, 5));
}

TEST_F(MassMomentsTest, ShiftWrenchesByTheirLever) {
  const Vector3d d = MakeRandomVector(3, &draw_);
  const Force3 F = Shift(ToVec3(d), {ToVec3(a_), ToVec3(b_)});
  EXPECT_NEAR((ToEigen(F.angular) - (a_ + d.cross(b_))).norm(), 0,
              Rounding(4, 3));
  EXPECT_EQ(ToEigen(F.linear), b_);
}

TEST_F(MassMomentsTest, WrenchesAddByPart) {
  const Force3 F =
      Force3{ToVec3(a_), ToVec3(b_)} + Force3{{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(ToEigen(F.angular), Vector3d(a_ + Vector3d(1, 2, 3)));
  EXPECT_EQ(ToEigen(F.linear), Vector3d(b_ + Vector3d(4, 5, 6)));
}

TEST_F(MassMomentsTest, ComeBackFromArrays) {
  MassMomentsArray moments(3);
  Force3Array wrenches(3);
  moments.Set(1, M_);
  wrenches.Set(1, {ToVec3(a_), ToVec3(b_)});
  ExpectMoments(moments[1], points_);
  EXPECT_EQ(ToEigen(wrenches[1].angular), a_);
  EXPECT_EQ(ToEigen(wrenches[1].linear), b_);
  EXPECT_EQ(moments[0].mass, 0);
  EXPECT_EQ(moments[2].mass, 0);
}

}  // namespace
}  // namespace poise
