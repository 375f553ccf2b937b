// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/ridders.h"

#include <gtest/gtest.h>

#include <cmath>

namespace poise {
namespace {

using Eigen::VectorXd;

TEST(RiddersJacobian, MatchesAnalyticJacobian) {
  const Eigen::MatrixXd J = RiddersJacobian(
      [](const VectorXd& x) {
        return VectorXd(Eigen::Vector2d(std::sin(3 * x[0]) * x[1], x[1]));
      },
      Eigen::Vector2d(0.5, 2));
  Eigen::Matrix2d expected;
  expected << 6 * std::cos(1.5), std::sin(1.5), 0, 1;
  EXPECT_LT((J - expected).norm(), kRiddersPrecision);
}

TEST(RiddersRate, MatchesAnalyticDerivative) {
  const VectorXd rate = RiddersRate(
      [](double t) { return VectorXd::Constant(1, std::exp(2 * t)); });
  EXPECT_LT(std::abs(rate[0] - 2), kRiddersPrecision);
}

TEST(RiddersJacobian, DetectsWrongDerivative) {
  const VectorXd rate =
      RiddersRate([](double t) { return VectorXd::Constant(1, t * t + t); });
  EXPECT_GT(std::abs(rate[0] - 1.0001), kRiddersPrecision);
}

}  // namespace
}  // namespace poise
