// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/simd/lanes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "poise/math/spatial.h"
#include "poise/math/vector6.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class LanesTest : public testing::Test {
 protected:
  Matrix3d MakeMatrix() {
    Matrix3d A;
    for (int i = 0; i < 3; ++i) A.col(i) = MakeRandomVector(3, &draw_);
    return A;
  }

  std::mt19937 draw_{1};
  Vector3d a_ = MakeRandomVector(3, &draw_);
  Vector3d b_ = MakeRandomVector(3, &draw_);
  Matrix3d A_ = MakeMatrix();
  Matrix3d B_ = MakeMatrix();
  double tolerance_ = Rounding(4, 9);
};

TEST_F(LanesTest, VectorsAreEigens) {
  const Vec3 a = ToVec3(a_), b = ToVec3(b_);
  EXPECT_EQ(ToEigen(a), a_);
  EXPECT_EQ(ToEigen(a + b), a_ + b_);
  EXPECT_EQ(ToEigen(a - b), a_ - b_);
  EXPECT_EQ(ToEigen(2.5 * a), 2.5 * a_);
  EXPECT_NEAR(Dot(a, b), a_.dot(b_), tolerance_);
  EXPECT_NEAR((ToEigen(Cross(a, b)) - a_.cross(b_)).norm(), 0, tolerance_);
}

TEST_F(LanesTest, MotionsAndForcesAreMaths) {
  const Vector3d c = MakeRandomVector(3, &draw_);
  const SpatialMotion V(a_, b_), W(b_, c);
  const SpatialForce F(c, a_), G(b_, a_);
  const Motion3 V3{ToVec3(a_), ToVec3(b_)}, W3{ToVec3(b_), ToVec3(c)};
  const Force3 F3 = ToForce3(F), G3 = ToForce3(G);
  const auto vector = [](const auto& x) {
    return (Vector6d() << ToEigen(x.angular), ToEigen(x.linear)).finished();
  };
  EXPECT_EQ(vector(V3 + W3), (V + W).vector());
  EXPECT_EQ(vector(F3), F.vector());
  EXPECT_EQ(vector(F3 + G3), (F + G).vector());
  EXPECT_EQ(vector(F3 - G3), (F - G).vector());
  EXPECT_NEAR(Dot(V3, F3), Dot(V, F), tolerance_);
  // p_BP = - p_PB.
  EXPECT_NEAR((vector(Shift(ToVec3(b_), F3)) - Shift(F, -b_).vector()).norm(),
              0, tolerance_);
}

TEST_F(LanesTest, MatricesAreEigens) {
  const Mat3 A = ToMat3(A_), B = ToMat3(B_);
  EXPECT_EQ(ToEigen(A), A_);
  EXPECT_EQ(ToEigen(A + B), A_ + B_);
  EXPECT_EQ(ToEigen(2.5 * A), 2.5 * A_);
  EXPECT_NEAR((ToEigen(A * ToVec3(a_)) - A_ * a_).norm(), 0, tolerance_);
  EXPECT_NEAR((ToEigen(RowTimes(ToVec3(a_), A)) - A_.transpose() * a_).norm(),
              0, tolerance_);
  EXPECT_NEAR((ToEigen(A * B) - A_ * B_).norm(), 0, tolerance_);
}

TEST_F(LanesTest, SymmetricMatricesAreEigens) {
  const Sym3 S{1, 2, 3, 4, 5, 6}, T{7, 9, 8, 3, 2, 1};
  Matrix3d S_eigen;
  S_eigen << 1, 4, 5, 4, 2, 6, 5, 6, 3;
  EXPECT_EQ(ToEigen(S), S_eigen);
  EXPECT_EQ(ToEigen(S + T), S_eigen + ToEigen(T));
  EXPECT_NEAR((ToEigen(S * ToVec3(a_)) - S_eigen * a_).norm(), 0,
              Rounding(10, 3));
  EXPECT_NEAR(
      (ToEigen(Rotate(ToMat3(A_), S)) - A_ * S_eigen * A_.transpose()).norm(),
      0, Rounding(100, 9));
}

TEST_F(LanesTest, ArraysKeepEachEntry) {
  Vec3Array vectors(3);
  Force3Array forces(3);
  Mat3Array matrices(3);
  Sym3Array symmetric(3);
  vectors.Set(1, ToVec3(a_));
  forces.Set(1, {ToVec3(b_), ToVec3(a_)});
  matrices.Set(1, ToMat3(A_));
  symmetric.Set(1, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(ToEigen(vectors[1]), a_);
  EXPECT_EQ(ToEigen(forces[1].angular), b_);
  EXPECT_EQ(ToEigen(forces[1].linear), a_);
  EXPECT_EQ(ToEigen(matrices[1]), A_);
  EXPECT_EQ(ToEigen(symmetric[1]), ToEigen(Sym3{1, 2, 3, 4, 5, 6}));
  for (const int other : {0, 2}) {
    EXPECT_TRUE(ToEigen(vectors[other]).isZero(0));
    EXPECT_TRUE(ToEigen(forces[other].angular).isZero(0));
    EXPECT_TRUE(ToEigen(forces[other].linear).isZero(0));
    EXPECT_TRUE(ToEigen(matrices[other]).isZero(0));
    EXPECT_TRUE(ToEigen(symmetric[other]).isZero(0));
  }
}

}  // namespace
}  // namespace poise
