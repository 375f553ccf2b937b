// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/limits.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

TEST(JointViolation, ReturnsTheLargestViolation) {
  Robot robot = MakePendulum();
  robot.model.limits[0].lower = -0.5;
  robot.model.limits[0].upper = 0.75;
  const auto at = [&robot](double q) {
    return JointViolation(robot.model, Eigen::VectorXd::Constant(1, q));
  };
  EXPECT_EQ(at(0.25), 0);
  EXPECT_EQ(at(1), 0.25);
  EXPECT_EQ(at(-0.625), 0.125);
}

// The position of the base has no limits.
TEST(JointViolation, IsZeroWithoutALimit) {
  const Robot block = MakeBlock({0.2, 0.1, 0.3}, 5);
  EXPECT_EQ(JointViolation(block.model, Eigen::VectorXd::Constant(7, 9)), 0);
  EXPECT_EQ(
      JointViolation(MakePendulum().model, Eigen::VectorXd::Constant(1, 9)), 0);
}

}  // namespace
}  // namespace poise
