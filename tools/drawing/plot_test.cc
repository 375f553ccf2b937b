// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/plot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace poise {
namespace {

TEST(Plot, TicksAreRoundAndCoverTheRange) {
  for (const auto& [low, high] : {std::pair{0.0, 1.0},
                                  {-0.013, 0.0371},
                                  {0.0, 6.0},
                                  {-900.0, 12.0},
                                  {5.0001, 5.0002},
                                  {-1e-7, 1e-7},
                                  {0.0, 7.3e5}}) {
    for (const int most : {3, 6, 10}) {
      SCOPED_TRACE(testing::Message() << low << " to " << high << ", " << most);
      const std::vector<double> ticks = RoundTicks(low, high, most);
      ASSERT_GE(ticks.size(), 2u);
      EXPECT_LE(ticks.size(), most + 1u);
      const double step = ticks[1] - ticks[0];
      EXPECT_LE(ticks.front(), low + 1e-6 * step);
      EXPECT_GE(ticks.back(), high - 1e-6 * step);
      EXPECT_GT(ticks.front(), low - step);
      EXPECT_LT(ticks.back(), high + step);
      const double mantissa =
          step / std::pow(10, std::floor(std::log10(step) + 1e-9));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 ||
                  std::abs(mantissa - 2) < 1e-6 ||
                  std::abs(mantissa - 5) < 1e-6)
          << mantissa;
    }
  }
}

}  // namespace
}  // namespace poise
