// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/step_trigger.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/tests/util/arbitrary.h"

namespace poise {
namespace {

constexpr SupportBox kBox{0.12, 0.08, 0.14, 0.14};

// Integrates xi' = w (xi - p) + a / w with the best constant CoP of a fine
// grid: the one that leaves xi nearest to the middle.
double LeastFraction(double xi, double a, double omega, double T, double plus,
                     double minus) {
  double least = 1e9;
  for (int k = 0; k <= 200; ++k) {
    const double p = -minus + (plus + minus) * k / 200;
    double x = xi;
    const int steps = 200;
    const double h = T / steps;
    for (int i = 0; i < steps; ++i) {
      const auto rate = [&](double at) { return omega * (at - p) + a / omega; };
      const double k1 = rate(x), k2 = rate(x + h / 2 * k1);
      const double k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
      x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    least = std::min(least, x > 0 ? x / plus : -x / minus);
  }
  return least;
}

// Beyond the edge no CoP of the box gives a smaller fraction.
RC_GTEST_PROP(StepTrigger, NoCopKeepsXiNearer, ()) {
  const double xi = *Numbers(0.3);
  const double a = *Numbers(15);
  const double omega = 3.5;
  const double T = 0.001 * *rc::gen::inRange(0, 120);
  const EdgeFractions found =
      PredictEdgeFractions({xi, 0}, {a, 0}, omega, T, kBox);
  const double least = LeastFraction(xi, a, omega, T, kBox.front, kBox.back);
  // A CoP of the grid is at most half of its spacing from the best one; an
  // edge is in the grid. The error of Runge-Kutta is far below 1e-9.
  const double grid =
      0.5 * (kBox.front + kBox.back) / 200 / kBox.back * std::expm1(omega * T);
  RC_ASSERT(found.sagittal <= least + 1e-9);
  RC_ASSERT(found.sagittal >= least - grid - 1e-9);
}

TEST(StepTrigger, WithoutPushIsTheFractionOfTheCapturePoint) {
  const EdgeFractions ahead =
      PredictEdgeFractions({0.06, -0.07}, {0, 0}, 3.5, 0, kBox);
  EXPECT_DOUBLE_EQ(ahead.sagittal, 0.5);
  EXPECT_DOUBLE_EQ(ahead.lateral, 0.5);
  EXPECT_EQ(ahead.beyond, 0);
  const EdgeFractions behind =
      PredictEdgeFractions({-0.06, 0.07}, {0, 0}, 3.5, 0, kBox);
  EXPECT_DOUBLE_EQ(behind.sagittal, 0.75);
  EXPECT_DOUBLE_EQ(behind.lateral, 0.5);
}

TEST(StepTrigger, MeasuresTheDistanceBeyondTheFartherEdge) {
  const EdgeFractions both =
      PredictEdgeFractions({0.15, -0.16}, {0, 0}, 3.5, 0, kBox);
  EXPECT_NEAR(both.beyond, 0.03, 1e-15);  // In front 3 cm, to the right 2 cm.
  EXPECT_NEAR(both.sagittal, 0.15 / 0.12, 1e-15);
}

TEST(StepTrigger, AnyAxisTriggers) {
  const StepTrigger trigger{1, 1.1, 1.9};
  EXPECT_FALSE(trigger.IsNeeded({0.8, 1.09, 0}));
  EXPECT_FALSE(trigger.IsNeeded({0.99, 0.9, 0}));
  EXPECT_TRUE(trigger.IsNeeded({0.95, 0.96, 0}));
  EXPECT_TRUE(trigger.IsNeeded({1.01, 0, 0}));
  EXPECT_TRUE(trigger.IsNeeded({0, 1.11, 0}));
}

}  // namespace
}  // namespace poise
