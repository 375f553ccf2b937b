// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/step_yardstick.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

std::vector<Eigen::Vector2d> Box(double x0, double x1, double y0, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// Moves a pendulum by Runge-Kutta: xi' = w (xi - p) + F / (m w).
Eigen::Vector2d XiAt(double T, Eigen::Vector2d xi, const Eigen::Vector2d& p,
                     double omega, const Eigen::Vector2d& push, double T_p) {
  constexpr int kSteps = 300;
  const double h = T / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    // The force is constant inside a step: T_p is a multiple of h.
    const Eigen::Vector2d f =
        (i + 0.5) * h < T_p ? push : Eigen::Vector2d::Zero().eval();
    const auto rate = [&](const Eigen::Vector2d& x) {
      return (omega * (x - p) + f).eval();
    };
    const Eigen::Vector2d k1 = rate(xi), k2 = rate(xi + h / 2 * k1);
    const Eigen::Vector2d k3 = rate(xi + h / 2 * k2), k4 = rate(xi + h * k3);
    xi += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return xi;
}

// The bound agrees with a search: the pendulum is pushed, its CoP stays at one
// of many places of the stance sole, and the other sole lands at one of many
// places; the robot is caught if xi is then inside the hull of the two soles,
// which for boxes side by side is a box.
RC_GTEST_PROP(StepYardstick, AgreesWithASearchOverCopAndPlace, ()) {
  const double m = 30, g = 9.81, h = 0.8, T = 0.3;
  const double omega = std::sqrt(g / h);
  const double T_p = 0.001 * *rc::gen::inRange(1, 299);
  const double reach = 0.2 + 0.001 * *rc::gen::inRange(0, 400);
  const bool forward = *rc::gen::arbitrary<bool>();
  const Eigen::Vector2d u = forward ? Eigen::Vector2d::UnitX().eval()
                                    : Eigen::Vector2d::UnitY().eval();
  // The right sole stays; the left one, of the same size, lands up to `reach`
  // in front of it and 0.16 to `reach` beside it.
  const double X = 0.1, Y = 0.05;
  StepOption option;
  option.stance = Box(-X, X, -0.08 - Y, -0.08 + Y);
  option.landing =
      Box(-X, reach + X, 0.08 - Y, -0.08 + std::max(0.16, reach) + Y);
  const Eigen::Vector3d com(0, 0, h);
  const double found = ComputeStepYardstick(m, g, com, option, u, T_p, T);

  const auto is_caught = [&](double impulse) {
    const Eigen::Vector2d push = impulse / T_p / (m * omega) * u;
    for (int k = 0; k <= 20; ++k) {
      // The best CoP is at the stance sole's edge along the push, in the other
      // axis anywhere.
      const Eigen::Vector2d p =
          forward ? Eigen::Vector2d(X, -0.08 - Y + 2 * Y * k / 20)
                  : Eigen::Vector2d(-X + 2 * X * k / 20, -0.08 + Y);
      const Eigen::Vector2d xi =
          XiAt(T, Eigen::Vector2d::Zero(), p, omega, push, T_p);
      for (int i = 0; i <= 20; ++i) {
        const double along = forward ? reach : std::max(0.16, reach) - 0.08;
        const double a =
            forward ? along * i / 20 : 0.08 + (along - 0.08) * i / 20;
        const double low = forward ? -X : -0.08 - Y;
        const double high = a + (forward ? X : Y);
        const double across = forward ? xi.y() : xi.x();
        const double xi_u = u.dot(xi);
        const bool is_across =
            forward ? across > -0.08 - Y && across < -0.08 + 0.16 + Y
                    : std::abs(across) < X;
        if (is_across && xi_u > low && xi_u < high) return true;
      }
    }
    return false;
  };
  // T_p is rounded to the steps of 1 ms, within which the force is constant.
  RC_ASSERT(is_caught(0.995 * found));
  RC_ASSERT(!is_caught(1.005 * found));
}

// One axis: d = r + (l + rho - r) e, see Koolen et al. 2012.
TEST(StepYardstick, IsTheFormulaAlongOneAxis) {
  const double m = 40, g = 9.81, h = 0.9, T = 0.3, l = 0.5, r = 0.12;
  const double omega = std::sqrt(g / h);
  const StepOption option{Box(-r, r, -0.05, 0.05),
                          Box(-l - r, l + r, -0.05, 0.05)};
  const double d = r + (l + r - r) * std::exp(-omega * T);
  EXPECT_NEAR(ComputeStepYardstick(m, g, {0, 0, h}, option,
                                   Eigen::Vector2d::UnitX(), 0, T),
              m * omega * d, 1e-12 * m * omega);
}

TEST(StepYardstick, OfTheHumanoidIsSymmetricAndAboveThatInPlace) {
  const Robot robot = LoadHumanoid();
  for (const double degrees : {0., 30., 60., 90., 120., 150., 180.}) {
    const double a = degrees * M_PI / 180;
    const Eigen::Vector2d u(std::cos(a), std::sin(a));
    const double left = *ComputeStepYardstick(robot, u, 0.1);
    const double right = *ComputeStepYardstick(robot, {u.x(), -u.y()}, 0.1);
    // The robot is the same on both sides; its reach is searched in steps of
    // 1 cm, which change the bound by 1 N s.
    EXPECT_NEAR(left, right, 1.5) << degrees;
    EXPECT_GT(left, 30) << degrees;  // In place it is 18 to 27 N s.
    EXPECT_LT(left, 80) << degrees;  // With the whole leg as reach.
  }
}

// A longer push, at the same impulse, is easier; a later landing is harder.
TEST(StepYardstick, GrowsWithTheDurationAndFallsWithTheTimeOfTheStep) {
  const StepOption option{Box(-0.1, 0.1, -0.05, 0.05),
                          Box(-0.5, 0.5, -0.4, 0.4)};
  const auto bound = [&](double T_p, double T) {
    return ComputeStepYardstick(40, 9.81, {0, 0, 0.9}, option, {1, 0}, T_p, T);
  };
  EXPECT_LT(bound(0.05, 0.3), bound(0.1, 0.3));
  EXPECT_LT(bound(0.1, 0.3), bound(0.5, 0.3));
  EXPECT_GT(bound(0.1, 0.25), bound(0.1, 0.3));
}

}  // namespace
}  // namespace poise
