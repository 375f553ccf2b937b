// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <ceres/gradient_checker.h>
#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "poise/math/quaternion.h"
#include "poise/math/se3.h"
#include "poise/math/se3_jacobian.h"
#include "poise/math/so3.h"
#include "poise/math/so3_jacobian.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Accuracy of Ridders' method according to Ceres' own tests.
constexpr double kRidders =
    1e-9;  // Relative error of each entry; no entry is tiny.

Vector6d Twist(const Vector3d& w, const Vector3d& v) {
  return (Vector6d() << w, v).finished();
}

rc::Gen<Vector6d> Twists(double max_angle) {
  return rc::gen::map(rc::gen::pair(RotationVectors(max_angle), Vectors()),
                      [](const std::pair<Vector3d, Vector3d>& x) -> Vector6d {
                        return Twist(x.first, x.second);
                      });
}

// A function of n numbers with m values, and its analytic derivative. Ceres
// differentiates the function and compares.
template <int m, int n>
class Claim final : public ceres::SizedCostFunction<m, n> {
 public:
  using Value = Eigen::Matrix<double, m, 1>;
  using Argument = Eigen::Matrix<double, n, 1>;
  using Jacobian = Eigen::Matrix<double, m, n>;

  Claim(std::function<Value(const Argument&)> value,
        std::function<Jacobian(const Argument&)> jacobian)
      : value_(std::move(value)), jacobian_(std::move(jacobian)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Argument x = Eigen::Map<const Argument>(parameters[0]);
    Eigen::Map<Value> value(residuals);
    value = value_(x);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, m, n, Eigen::RowMajor>> J(jacobians[0]);
      J = jacobian_(x);
    }
    return true;
  }

  bool Holds(const Argument& x, const ceres::Manifold* manifold = nullptr) {
    const std::vector<const ceres::Manifold*> manifolds{manifold};
    ceres::GradientChecker checker(this, &manifolds,
                                   ceres::NumericDiffOptions());
    const double* parameters[] = {x.data()};
    return checker.Probe(parameters, kRidders, nullptr);
  }

 private:
  std::function<Value(const Argument&)> value_;
  std::function<Jacobian(const Argument&)> jacobian_;
};

// d -> log(exp(w + d) exp(w)^-1) has the derivative J_l(w) at d = 0. With the
// inverse on the left, the derivative is J_r(w).
Claim<3, 3> LeftSo3(const Vector3d& w, const Matrix3d& J) {
  return {[w](const Vector3d& d) -> Vector3d {
            return LogSo3(ExpSo3(w + d) * ExpSo3(-w));
          },
          [J](const Vector3d&) { return J; }};
}

Claim<3, 3> RightSo3(const Vector3d& w, const Matrix3d& J) {
  return {[w](const Vector3d& d) -> Vector3d {
            return LogSo3(ExpSo3(-w) * ExpSo3(w + d));
          },
          [J](const Vector3d&) { return J; }};
}

// d -> log(exp(d) exp(w)) has the derivative J_l(w)^-1.
Claim<3, 3> InverseLeftSo3(const Vector3d& w, const Matrix3d& J) {
  return {[w](const Vector3d& d) -> Vector3d {
            return LogSo3(ExpSo3(d) * ExpSo3(w));
          },
          [J](const Vector3d&) { return J; }};
}

Claim<3, 3> InverseRightSo3(const Vector3d& w, const Matrix3d& J) {
  return {[w](const Vector3d& d) -> Vector3d {
            return LogSo3(ExpSo3(w) * ExpSo3(d));
          },
          [J](const Vector3d&) { return J; }};
}

TEST(So3Jacobians, AreDerivativesByCeres) {
  for (const Vector3d& w :
       {Vector3d(0, 0, 0), Vector3d(0.03, -0.01, 0.02),
        Vector3d(0.3, -0.5, 0.2), Vector3d(1, 1, 0.1), Vector3d(-1.3, 2, 1),
        Vector3d(0, 0, 5), Vector3d(4, -5, 3)}) {
    SCOPED_TRACE(w.transpose());
    EXPECT_TRUE(LeftSo3(w, LeftJacobianSo3(w)).Holds(Vector3d::Zero()));
    EXPECT_TRUE(RightSo3(w, RightJacobianSo3(w)).Holds(Vector3d::Zero()));
    if (w.norm() > 3) continue;  // There, the logarithm is on another branch.
    EXPECT_TRUE(
        InverseLeftSo3(w, InverseLeftJacobianSo3(w)).Holds(Vector3d::Zero()));
    EXPECT_TRUE(
        InverseRightSo3(w, InverseRightJacobianSo3(w)).Holds(Vector3d::Zero()));
  }
}

TEST(So3Jacobians, CheckerFindsAWrongJacobian) {
  const Vector3d w(0.3, -0.5, 0.2), zero = Vector3d::Zero();
  EXPECT_FALSE(LeftSo3(w, RightJacobianSo3(w)).Holds(zero));
  EXPECT_FALSE(RightSo3(w, LeftJacobianSo3(w)).Holds(zero));
  EXPECT_FALSE(InverseLeftSo3(w, LeftJacobianSo3(w)).Holds(zero));
  Matrix3d J = LeftJacobianSo3(w);
  J(0, 1) += 1e-7;
  EXPECT_FALSE(LeftSo3(w, J).Holds(zero));
}

// On the manifold of unit quaternions, f(q) = log(q) has the derivative 2
// J_l^-1 or 2 J_r^-1 in Ceres' coordinates d of q exp(d/2).
TEST(So3Jacobians, AreDerivativesOnCeresManifold) {
  const ceres::EigenQuaternionManifold manifold;
  for (const Vector3d& w : {Vector3d(0.3, -0.5, 0.2), Vector3d(-1, 1.2, 0.5)}) {
    SCOPED_TRACE(w.transpose());
    const Eigen::Quaterniond q = ExpQuaternion(w);
    // Ceres moves by q <- [sin|d| d/|d|, cos|d|] q, a rotation by 2 d on the
    // left.
    const Eigen::Matrix<double, 3, 3> J = 2 * InverseLeftJacobianSo3(w);
    Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
    manifold.PlusJacobian(q.coeffs().data(), plus.data());
    Claim<3, 4> claim(
        [](const Eigen::Vector4d& x) -> Vector3d {
          return LogQuaternion(Eigen::Quaterniond(x));
        },
        [J, plus](const Eigen::Vector4d&) -> Eigen::Matrix<double, 3, 4> {
          // Several derivatives in the surrounding space agree along the
          // manifold. This one is zero across the manifold.
          return J * plus.transpose() / plus.col(0).squaredNorm();
        });
    EXPECT_TRUE(claim.Holds(q.coeffs(), &manifold));
    Claim<3, 4> wrong(
        [](const Eigen::Vector4d& x) -> Vector3d {
          return LogQuaternion(Eigen::Quaterniond(x));
        },
        [J, plus](const Eigen::Vector4d&) -> Eigen::Matrix<double, 3, 4> {
          return J.transpose() * plus.transpose() / plus.col(0).squaredNorm();
        });
    EXPECT_FALSE(wrong.Holds(q.coeffs(), &manifold));
  }
}

Claim<6, 6> LeftSe3(const Vector6d& x, const Matrix6d& J) {
  return {[x](const Vector6d& d) -> Vector6d {
            return LogSe3(ExpSe3(x + d) * ExpSe3(-x));
          },
          [J](const Vector6d&) { return J; }};
}

Claim<6, 6> RightSe3(const Vector6d& x, const Matrix6d& J) {
  return {[x](const Vector6d& d) -> Vector6d {
            return LogSe3(ExpSe3(-x) * ExpSe3(x + d));
          },
          [J](const Vector6d&) { return J; }};
}

Claim<6, 6> InverseLeftSe3(const Vector6d& x, const Matrix6d& J) {
  return {[x](const Vector6d& d) -> Vector6d {
            return LogSe3(ExpSe3(d) * ExpSe3(x));
          },
          [J](const Vector6d&) { return J; }};
}

Claim<6, 6> InverseRightSe3(const Vector6d& x, const Matrix6d& J) {
  return {[x](const Vector6d& d) -> Vector6d {
            return LogSe3(ExpSe3(x) * ExpSe3(d));
          },
          [J](const Vector6d&) { return J; }};
}

TEST(Se3Jacobians, AreDerivativesByCeres) {
  const Vector6d zero = Vector6d::Zero();
  for (const Vector3d& w : {Vector3d(0, 0, 0), Vector3d(0.03, -0.01, 0.02),
                            Vector3d(0.3, -0.5, 0.2), Vector3d(1, 1, 0.1),
                            Vector3d(-1.3, 2, 1), Vector3d(4, -5, 3)}) {
    SCOPED_TRACE(w.transpose());
    const Vector6d x = Twist(w, {0.7, 0.4, -0.9});
    EXPECT_TRUE(LeftSe3(x, LeftJacobianSe3(x)).Holds(zero));
    EXPECT_TRUE(RightSe3(x, RightJacobianSe3(x)).Holds(zero));
    if (w.norm() > 3) continue;  // There, the logarithm is on another branch.
    EXPECT_TRUE(InverseLeftSe3(x, InverseLeftJacobianSe3(x)).Holds(zero));
    EXPECT_TRUE(InverseRightSe3(x, InverseRightJacobianSe3(x)).Holds(zero));
  }
}

TEST(Se3Jacobians, CheckerFindsAWrongJacobian) {
  const Vector6d x = Twist({0.3, -0.5, 0.2}, {0.7, 0.4, -0.9});
  const Vector6d zero = Vector6d::Zero();
  EXPECT_FALSE(LeftSe3(x, RightJacobianSe3(x)).Holds(zero));
  EXPECT_FALSE(RightSe3(x, LeftJacobianSe3(x)).Holds(zero));
  EXPECT_FALSE(InverseLeftSe3(x, LeftJacobianSe3(x)).Holds(zero));
  Matrix6d J = LeftJacobianSe3(x);
  J(4, 1) += 1e-7;
  EXPECT_FALSE(LeftSe3(x, J).Holds(zero));
}

RC_GTEST_PROP(So3Jacobians, InvertEachOther, ()) {
  const Vector3d w = *RotationVectors(6);
  // Six is 20 times closer to 2 π than to 0.
  const double tolerance = Rounding(1, 9, 25);
  RC_ASSERT(
      (LeftJacobianSo3(w) * InverseLeftJacobianSo3(w) - Matrix3d::Identity())
          .norm() <= tolerance);
  RC_ASSERT(
      (RightJacobianSo3(w) * InverseRightJacobianSo3(w) - Matrix3d::Identity())
          .norm() <= tolerance);
}

RC_GTEST_PROP(So3Jacobians, DifferByTheRotation, ()) {
  const Vector3d w = *RotationVectors(4 * M_PI);
  // Rounding of the rotation: 4 eps times the angle.
  const double tolerance = Rounding(4 * M_PI, 2);
  RC_ASSERT((LeftJacobianSo3(w) - ExpSo3(w) * RightJacobianSo3(w)).norm() <=
            tolerance);
  RC_ASSERT((RightJacobianSo3(w) - LeftJacobianSo3(w).transpose()).norm() <=
            tolerance);
  RC_ASSERT(RightJacobianSo3(w) == LeftJacobianSo3(-w));
}

// exp(w) - I = J_l(w) Hat(w) is the integral of the derivative along w.
RC_GTEST_PROP(So3Jacobians, IntegrateToTheExponential, ()) {
  const Vector3d w = *RotationVectors(4 * M_PI);
  RC_ASSERT(
      (LeftJacobianSo3(w) * Hat(w) + Matrix3d::Identity() - ExpSo3(w)).norm() <=
      Rounding(4 * M_PI, 2));
}

RC_GTEST_PROP(Se3Jacobians, InvertEachOther, ()) {
  const Vector6d x = *Twists(6);
  // The condition of SO(3), squared because of the derivative; velocities up to
  // 17.
  const double tolerance = Rounding(17, 18, 25 * 25);
  RC_ASSERT(
      (LeftJacobianSe3(x) * InverseLeftJacobianSe3(x) - Matrix6d::Identity())
          .norm() <= tolerance);
  RC_ASSERT(
      (RightJacobianSe3(x) * InverseRightJacobianSe3(x) - Matrix6d::Identity())
          .norm() <= tolerance);
}

RC_GTEST_PROP(Se3Jacobians, DifferByTheAdjoint, ()) {
  const Vector6d x = *Twists(4 * M_PI);
  RC_ASSERT(
      (LeftJacobianSe3(x) - Adjoint(ExpSe3(x)) * RightJacobianSe3(x)).norm() <=
      Rounding(17 * 4 * M_PI, 6));
}

// Compares with Barfoot's (7.86), Q by products of matrices.
RC_GTEST_PROP(Se3Jacobians, QIsBarfootsQ, ()) {
  const Vector3d w = *RotationVectors(6), v = *Vectors();
  // For small angles Barfoot's coefficients lose digits like the fifth power of
  // the angle.
  RC_PRE(w.norm() > 1);
  const double a = w.norm(), c = std::cos(a), s = std::sin(a);
  const Matrix3d W = Hat(w), V = Hat(v);
  const Matrix3d Q = V / 2 +
                     (a - s) / std::pow(a, 3) * (W * V + V * W + W * V * W) -
                     (1 - a * a / 2 - c) / std::pow(a, 4) *
                         (W * W * V + V * W * W - 3 * W * V * W) -
                     0.5 *
                         ((1 - a * a / 2 - c) / std::pow(a, 4) -
                          3 * (a - s - std::pow(a, 3) / 6) / std::pow(a, 5)) *
                         (W * V * W * W + W * W * V * W);
  const Matrix6d J = LeftJacobianSe3(Twist(w, v));
  RC_ASSERT((J.bottomLeftCorner(3, 3) - Q).norm() <= Rounding(1000, 16));
  Matrix6d expected;
  expected << LeftJacobianSo3(w), Matrix3d::Zero(), J.bottomLeftCorner(3, 3),
      LeftJacobianSo3(w);
  RC_ASSERT(J == expected);
  const Matrix6d I = InverseLeftJacobianSe3(Twist(w, v));
  expected << InverseLeftJacobianSo3(w), Matrix3d::Zero(),
      I.bottomLeftCorner(3, 3), InverseLeftJacobianSo3(w);
  RC_ASSERT(I == expected);
}

TEST(Jacobians, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(testing::Message() << bad << " at " << i);
      Vector3d w(1, 2, 3);
      w[i] = bad;
      EXPECT_TRUE(LeftJacobianSo3(w).array().isNaN().all());
      EXPECT_TRUE(RightJacobianSo3(w).array().isNaN().all());
      EXPECT_TRUE(InverseLeftJacobianSo3(w).array().isNaN().all());
      EXPECT_TRUE(InverseRightJacobianSo3(w).array().isNaN().all());
      const Vector6d x = Twist(w, {1, 2, 3});
      EXPECT_TRUE(LeftJacobianSe3(x).leftCols<3>().array().isNaN().all());
      EXPECT_TRUE(RightJacobianSe3(x).leftCols<3>().array().isNaN().all());
      EXPECT_TRUE(
          InverseLeftJacobianSe3(x).leftCols<3>().array().isNaN().all());
      EXPECT_TRUE(
          InverseRightJacobianSe3(x).leftCols<3>().array().isNaN().all());
      const Vector6d y = Twist({1, 2, 3}, w);
      EXPECT_TRUE(
          LeftJacobianSe3(y).bottomLeftCorner(3, 3).array().isNaN().all());
      EXPECT_TRUE(InverseLeftJacobianSe3(y)
                      .bottomLeftCorner(3, 3)
                      .array()
                      .isNaN()
                      .all());
    }
  }
}

TEST(Jacobians, AllocateAndThrowNothing) {
  const Vector6d x = Twist({1, 2, 3}, {4, 5, 6});
  const Vector3d w = x.head<3>();
  CountMalloc count;
  const Matrix3d J = LeftJacobianSo3(w) * InverseRightJacobianSo3(w) +
                     RightJacobianSo3(w) * InverseLeftJacobianSo3(w);
  const Matrix6d K = LeftJacobianSe3(x) + InverseRightJacobianSe3(x) +
                     RightJacobianSe3(x) + InverseLeftJacobianSe3(x);
  EXPECT_EQ(count.allocations(), 0);
  EXPECT_GT(J.norm() + K.norm(), 0);
  static_assert(noexcept(LeftJacobianSo3(w))&& noexcept(RightJacobianSo3(w)));
  static_assert(noexcept(LeftJacobianSe3(x))&& noexcept(RightJacobianSe3(x)));
}

}  // namespace
}  // namespace poise
