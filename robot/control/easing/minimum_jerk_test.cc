// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/easing/minimum_jerk.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(MinimumJerk, GoesFromRestAtZeroToRestAtOne) {
  for (const double end : {0.0, 1.0}) {
    const MinimumJerk s(end);
    EXPECT_EQ(s.value, end);
    EXPECT_EQ(s.rate, 0);
    EXPECT_EQ(s.acceleration, 0);
  }
  // At half of the time, half of the way has passed; the rate is 15/8.
  const MinimumJerk s(0.5);
  EXPECT_EQ(s.value, 0.5);
  EXPECT_EQ(s.rate, 1.875);
  EXPECT_EQ(s.acceleration, 0);
}

TEST(MinimumJerk, RateAndAccelerationAreDerivatives) {
  constexpr double kStep = 1e-4;
  for (double t = 0.05; t < 1; t += 0.05) {
    const MinimumJerk before(t - kStep), now(t), after(t + kStep);
    // The third derivatives of both are at most 360.
    constexpr double kTruncation = 360 * kStep * kStep / 6 + 1e-11;
    EXPECT_NEAR(now.rate, (after.value - before.value) / (2 * kStep),
                kTruncation);
    EXPECT_NEAR(now.acceleration, (after.rate - before.rate) / (2 * kStep),
                kTruncation);
  }
}

}  // namespace
}  // namespace poise
