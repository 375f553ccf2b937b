// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/dcm.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

struct Pendulum {
  Eigen::Vector2d c, v;
};

// Integrates c'' = w² (c - p) by the classical Runge-Kutta method.
Pendulum Integrate(Pendulum x, const Eigen::Vector2d& p, double omega, double T,
                   int steps) {
  const double h = T / steps;
  const auto rate = [&](const Pendulum& at) {
    return Pendulum{at.v, omega * omega * (at.c - p)};
  };
  const auto add = [](const Pendulum& a, double f, const Pendulum& b) {
    return Pendulum{a.c + f * b.c, a.v + f * b.v};
  };
  for (int i = 0; i < steps; ++i) {
    const Pendulum k1 = rate(x);
    const Pendulum k2 = rate(add(x, h / 2, k1));
    const Pendulum k3 = rate(add(x, h / 2, k2));
    const Pendulum k4 = rate(add(x, h, k3));
    x = add(x, h / 6, k1);
    x = add(x, h / 3, k2);
    x = add(x, h / 3, k3);
    x = add(x, h / 6, k4);
  }
  return x;
}

struct Case {
  Pendulum start;
  Eigen::Vector2d p;
  double omega, T;
};

Case DrawCase() {
  const Eigen::VectorXd x = *VectorsXd(6, 1);
  return {{x.head<2>(), x.segment<2>(2)},
          x.tail<2>(),
          0.01 * *rc::gen::inRange(200, 500),
          0.001 * *rc::gen::inRange(1, 500)};
}

// The error of 100 steps: (w h)^5 per step, times the growth exp(w T).
double Tolerance(const Case& each) {
  const double wT = each.omega * each.T;
  return 10 * std::pow(wT / 100, 4) * wT * std::exp(wT) + 1e-13;
}

RC_GTEST_PROP(Dcm, PredictionsAgreeWithTheIntegratedPendulum, ()) {
  const Case each = DrawCase();
  const Pendulum end = Integrate(each.start, each.p, each.omega, each.T, 100);
  const Eigen::Vector2d xi = each.start.c + each.start.v / each.omega;
  const Eigen::Vector2d xi_T = PredictDcm(xi, each.p, each.omega, each.T);
  RC_ASSERT((xi_T - end.c - end.v / each.omega).norm() <= Tolerance(each));
  const Eigen::Vector2d c_T =
      PredictCom(each.start.c, each.start.v, each.p, each.omega, each.T);
  RC_ASSERT((c_T - end.c).norm() <= Tolerance(each));
}

RC_GTEST_PROP(Dcm, CopForDcmInvertsThePrediction, ()) {
  const Case each = DrawCase();
  const Eigen::Vector2d xi_T =
      PredictDcm(each.start.c, each.p, each.omega, each.T);
  const Eigen::Vector2d p = CopForDcm(each.start.c, xi_T, each.omega, each.T);
  // The division by exp(w T) - 1 loses the digits that this difference loses.
  const double condition = 1 / std::expm1(each.omega * each.T);
  RC_ASSERT((p - each.p).norm() <= Rounding(10, 4, 1 + condition));
}

// Second derivation: xi is that of a point mass at G which has the robot's
// angular momentum about the point on the ground below G.
TEST(Dcm, GivesBackTheAngularMomentum) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(tree.nv(), -1, 1.3);
  ComputeTick(tree, robot.q_nominal, v, &tick);
  const double m = tree.total_mass();
  const double h = tick.p_WG.z();
  const double omega = 3.5;

  const Eigen::Vector3d arm(0, 0, h);
  const Eigen::Vector3d L = arm.cross(m * tick.v_WG) + tick.L_G.head<3>();
  // arm x m v_point = L, for the horizontal components.
  const Eigen::Vector2d v_point(L.y() / (m * h), -L.x() / (m * h));
  const Eigen::Vector2d expected = tick.p_WG.head<2>() + v_point / omega;
  EXPECT_LT((ComputeDcm(tick, m, h, omega, 1) - expected).norm(),
            Rounding(expected.norm() + v_point.norm(), tree.nv()));
  const Eigen::Vector2d without =
      tick.p_WG.head<2>() + tick.v_WG.head<2>() / omega;
  EXPECT_EQ(ComputeDcm(tick, m, h, omega, 0), without);
  EXPECT_GT((expected - without).norm(), 0.01);  // The test can see k.
}

}  // namespace
}  // namespace poise
