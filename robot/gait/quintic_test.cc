// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/quintic.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Returns (1, t, t², ...) and its first two derivatives.
Eigen::Matrix<double, 3, 6> Powers(double t) {
  Eigen::Matrix<double, 3, 6> rows = Eigen::Matrix<double, 3, 6>::Zero();
  for (int i = 0; i < 6; ++i) {
    rows(0, i) = std::pow(t, i);
    if (i > 0) rows(1, i) = i * std::pow(t, i - 1);
    if (i > 1) rows(2, i) = i * (i - 1) * std::pow(t, i - 2);
  }
  return rows;
}

// Second derivation: the coefficients from the six boundary conditions.
Vector6 Coefficients(const Quintic& start, double goal, double T) {
  Eigen::Matrix<double, 6, 6> conditions;
  conditions << Powers(0), Powers(T);
  Vector6 values;
  values << start.p, start.v, start.a, goal, 0, 0;
  return conditions.fullPivLu().solve(values);
}

rc::Gen<Quintic> Quintics() {
  return rc::gen::map(VectorsXd(3, 10), [](const Eigen::VectorXd& x) {
    return Quintic{x[0], x[1], x[2]};
  });
}

// Times from 0.1 s to 1 s. The condition of the six equations grows with 1/T⁵.
rc::Gen<double> Times() {
  return rc::gen::map(rc::gen::inRange(100, 1001),
                      [](int ms) { return 1e-3 * ms; });
}

constexpr double kCondition = 1e6;  // At T = 0.1 s.

RC_GTEST_PROP(Quintic, FollowsTheBoundaryConditions, ()) {
  const Quintic start = *Quintics();
  const double goal = *Numbers(10);
  const double T = *Times();
  const Vector6 c = Coefficients(start, goal, T);
  const double share = 0.001 * *rc::gen::inRange(1, 1001);
  Quintic x = start;
  x.Advance(share * T, goal, T);
  const Eigen::Vector3d expected = Powers(share * T) * c;
  const double scale = c.cwiseAbs().maxCoeff();
  RC_ASSERT(std::abs(x.p - expected[0]) <= Rounding(scale, 6, kCondition));
  RC_ASSERT(std::abs(x.v - expected[1]) <= Rounding(scale, 6, kCondition));
  RC_ASSERT(std::abs(x.a - expected[2]) <= Rounding(scale, 6, kCondition));
}

RC_GTEST_PROP(Quintic, StepsGiveTheSamePolynomialAsOneStep, ()) {
  const Quintic start = *Quintics();
  const double goal = *Numbers(10);
  const double T = *Times();
  const int steps = *rc::gen::inRange(2, 20);
  Quintic one = start, many = start;
  one.Advance(0.9 * T, goal, T);
  for (int i = 0; i < steps; ++i) {
    const double dt = 0.9 * T / steps;
    many.Advance(dt, goal, T - i * dt);
  }
  // The last step divides by 0.1 T, and a by its square.
  const double scale = 1e4 * (std::abs(start.p) + std::abs(goal) +
                              std::abs(start.v) + std::abs(start.a) + 1);
  RC_ASSERT(std::abs(one.p - many.p) <= Rounding(scale, 20 * steps));
  RC_ASSERT(std::abs(one.v - many.v) <= Rounding(scale / T, 20 * steps));
  RC_ASSERT(std::abs(one.a - many.a) <= Rounding(scale / T / T, 20 * steps));
}

RC_GTEST_PROP(Quintic, ArrivesAtRest, ()) {
  Quintic x = *Quintics();
  const double goal = *Numbers(10);
  const double T = *Times();
  const double scale =
      std::abs(x.p) + std::abs(goal) + std::abs(x.v) + std::abs(x.a);
  x.Advance(T, goal, T);
  RC_ASSERT(std::abs(x.p - goal) <= Rounding(20 * scale, 6));
  RC_ASSERT(std::abs(x.v) <= Rounding(60 * scale / T, 6));
  RC_ASSERT(std::abs(x.a) <= Rounding(180 * scale / T / T, 6));
}

// A new goal in each tick: position, velocity and acceleration change by at
// most what the derivative of the polynomial allows in a tick.
RC_GTEST_PROP(Quintic, IsContinuousWhenTheGoalMoves, ()) {
  Quintic x;
  const double dt = 1e-3;
  for (int i = 0; i < 100; ++i) {
    const double T = 0.2 - i * dt;
    const double goal = *Numbers(1);
    const Quintic before = x;
    x.Advance(dt, goal, T);
    // |x'''| on the polynomial is at most 60 |way| / T³ + 36 |v| / T² + 9 |a| /
    // T, and it is attained at an end.
    const double jerk = 60 * std::abs(goal - before.p) / (T * T * T) +
                        36 * std::abs(before.v) / (T * T) +
                        9 * std::abs(before.a) / T;
    RC_ASSERT(std::abs(x.a - before.a) <= jerk * dt * (1 + 1e-9) + 1e-9);
    RC_ASSERT(std::abs(x.v - before.v - before.a * dt) <=
              jerk * dt * dt / 2 * (1 + 1e-9) + 1e-9);
  }
}

RC_GTEST_PROP(Quintic, BrakeIntegratesItsOwnVelocity, ()) {
  const Quintic start = *Quintics();
  const double tau = 0.02;
  Quintic once = start, twice = start;
  once.Brake(2e-3, tau);
  twice.Brake(1e-3, tau);
  twice.Brake(1e-3, tau);
  const double scale = std::abs(start.p) + std::abs(start.v);
  RC_ASSERT(std::abs(once.p - twice.p) <= Rounding(scale, 4));
  RC_ASSERT(std::abs(once.v - twice.v) <= Rounding(scale, 4));
  // The place where the motion ends does not depend on the time of the call.
  RC_ASSERT(std::abs(once.p + once.v * tau - start.p - start.v * tau) <=
            Rounding(scale, 4));
  RC_ASSERT(std::abs(once.a * tau + once.v) <= Rounding(scale, 4));
}

}  // namespace
}  // namespace poise
