// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/yardstick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

const std::vector<Eigen::Vector2d> kSoles = {
    {0.1, 0.05}, {-0.1, 0.15}, {0.1, -0.15}, {-0.1, -0.15},
    {0.1, 0.15}, {0, 0},       {-0.1, 0.05}};

// Returns whether the pendulum x'' = w^2 (x - p) + F / m returns after a force
// F over a time T. Its CoP p is always at the edge. The result comes from
// numerical integration, independently of the yardstick's formula.
bool Survives(double mass, double height, double edge, double force, double T) {
  const double w2 = 9.81 / height, dt = 1e-5;
  double x = 0, v = 0;
  for (double t = 0; t < 3; t += dt) {
    const double u = t < T ? force / mass : 0;
    v += dt * (w2 * (x - edge) + u);
    x += dt * v;
    if (v < 0) return true;
  }
  return false;
}

TEST(Yardstick, AgreesWithAnIntegratedPendulum) {
  for (const double T : {0.1, 0.3}) {
    SCOPED_TRACE(T);
    const Yardstick yardstick =
        ComputeYardstick(40, 9.81, {0, 0, 0.8}, kSoles, {1, 0}, T, 1.2);
    const double force = yardstick.lipm_Ns / T;
    EXPECT_TRUE(Survives(40, 0.8, 0.1, 0.999 * force, T));
    EXPECT_FALSE(Survives(40, 0.8, 0.1, 1.001 * force, T));
    EXPECT_DOUBLE_EQ(yardstick.lipm_height_Ns, yardstick.lipm_Ns * 0.8 / 1.2);
  }
}

TEST(Yardstick, GivesTheLimitOfShortPushesForAnImpulse) {
  const auto lipm = [](double T) {
    return ComputeYardstick(40, 9.81, {0, 0, 0.8}, kSoles, {0, -1}, T, 1)
        .lipm_Ns;
  };
  EXPECT_NEAR(lipm(0), lipm(1e-9), 1e-6);
  EXPECT_DOUBLE_EQ(lipm(0), 40 * std::sqrt(9.81 / 0.8) * 0.15);
}

TEST(Yardstick, MeasuresAlongThePush) {
  const auto rho = [](const Eigen::Vector3d& com, const Eigen::Vector2d& u) {
    return ComputeYardstick(40, 9.81, com, kSoles, u, 0, 1).lipm_Ns /
           (40 * std::sqrt(9.81 / com.z()));
  };
  EXPECT_NEAR(rho({0.02, 0, 0.8}, {1, 0}), 0.08, 1e-15);
  EXPECT_NEAR(rho({0.02, 0, 0.8}, {-2, 0}), 0.12, 1e-15);
  EXPECT_NEAR(rho({0, 0.05, 0.8}, {0, 3}), 0.1, 1e-15);
  EXPECT_NEAR(rho({0, 0, 0.8}, {1, 1}), 0.1 * std::sqrt(2), 1e-15);
  EXPECT_EQ(rho({0.2, 0, 0.8}, {-1, 0}), 0);
}

TEST(Yardstick, UsesTheSolesOfARobotInItsConfiguration) {
  const Robot robot = MakeBlock({0.2, 0.3, 1}, 10);
  Eigen::VectorXd q(7);
  q << 3, 4, 5, 0, 0, 0, 1;
  const Yardstick yardstick =
      ComputeYardstick(robot, q, {0, 1}, 0, 0, {0, 0, 0.25}).value();
  EXPECT_NEAR(yardstick.lipm_Ns, 10 * std::sqrt(9.81 / 0.5) * 0.15, 1e-12);
  EXPECT_NEAR(yardstick.lipm_height_Ns, yardstick.lipm_Ns * 0.5 / 0.75, 1e-12);
}

TEST(Yardstick, UsesOnlyTheFeetThatAreDown) {
  Robot robot = MakeBlock({0.2, 0.4, 1}, 10);
  robot.feet.push_back(robot.feet[0]);
  for (Foot& foot : robot.feet) {
    for (Eigen::Vector2d& corner : foot.polygon_C) corner.y() *= 0.5;
  }
  robot.feet[0].X_BC.p.y() = 0.1;
  robot.feet[1].X_BC.p.y() = -0.1;
  Eigen::VectorXd q(7);
  q << 0, 0, 5, 0, 0, 0, 1;
  const auto reach = [&](const std::vector<bool>& down, double y) {
    return ComputeYardstick(robot, q, {0, y}, 0, 0, {0, 0, 0}, down)->lipm_Ns /
           (10 * std::sqrt(9.81 / 0.5));
  };
  EXPECT_NEAR(reach({}, 1), 0.2, 1e-12);
  EXPECT_NEAR(reach({true, true}, 1), 0.2, 1e-12);
  EXPECT_NEAR(reach({true, false}, 1), 0.2, 1e-12);
  EXPECT_NEAR(reach({true, false}, -1), 0, 1e-12);
  EXPECT_EQ(reach({false, false}, 1), 0);
}

// The block is 1 m high, and its sole is 0.5 m below its center.
TEST(Yardstick, IsEmptyForPushOrCenterOfMassBelowTheSoles) {
  const Robot robot = MakeBlock({0.2, 0.3, 1}, 10);
  Eigen::VectorXd upright(7), upside_down(7);
  upright << 3, 4, 5, 0, 0, 0, 1;
  upside_down << 3, 4, 5, 1, 0, 0, 0;
  const auto yardstick = [&](const Eigen::VectorXd& q, double z) {
    return ComputeYardstick(robot, q, {0, 1}, 0, 0, {0, 0, z});
  };
  EXPECT_TRUE(yardstick(upright, -0.49));
  EXPECT_FALSE(yardstick(upright, -0.5));
  EXPECT_FALSE(yardstick(upright, -0.6));
  EXPECT_FALSE(yardstick(upright, std::nan("")));
  EXPECT_FALSE(yardstick(upside_down, -0.6));  // The push is above, G below.
}

}  // namespace
}  // namespace poise
