// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/exact_dot.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "poise/tests/util/arbitrary.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// Expects the same result for any order of the terms.
void ExpectDot(const Vector3d& a, const Vector3d& b, double near, double rest) {
  std::array<int, 3> order{0, 1, 2};
  do {
    SCOPED_TRACE(testing::Message() << order[0] << order[1] << order[2]);
    const auto& [i, j, k] = order;
    const TwoDoubles dot = ExactDot({a[i], a[j], a[k]}, {b[i], b[j], b[k]});
    EXPECT_EQ(dot.near, near);
    EXPECT_EQ(dot.rest, rest);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ExactDot, OfSmallNumbersIsTheirDotProduct) {
  ExpectDot({1, 2, 3}, {4, 5, 6}, 32, 0);
}

TEST(ExactDot, KeepsTheRemainderWhenTermsCancel) {
  // (1 + e) (1 - e) - 1 = -e²; in double, 1 - e² is 1.
  const double e = std::ldexp(1, -30);
  ExpectDot({1 + e, 1, 0}, {1 - e, -1, 5}, -e * e, 0);
  ExpectDot({1e20, 3, -1e20}, {1, 7, 1}, 21, 0);
}

TEST(ExactDot, KeepsDigitsBeyondOneDouble) {
  const double tiny = std::ldexp(1, -60);
  ExpectDot({1, 1, 0}, {1, tiny, 0}, 1, tiny);
  ExpectDot({1, -1, 1}, {1, tiny, tiny / 4}, 1, -0.75 * tiny);
}

// In units of 2^-40 all products and sums are integers below 2^106.
RC_GTEST_PROP(ExactDot, IsRightToTheLastBitOfTwoDoubles, ()) {
  __int128 exact = 0;
  Vector3d a, b;
  for (int i = 0; i < 3; ++i) {
    const long x = *rc::gen::inRange(-(1L << 50), 1L << 50);
    const long y = *rc::gen::inRange(-(1L << 50), 1L << 50);
    a[i] = static_cast<double>(x);
    b[i] = static_cast<double>(y);
    exact += static_cast<__int128>(x) * y;
  }
  const TwoDoubles dot = ExactDot(a, b);
  RC_ASSERT(dot.near == static_cast<double>(exact));
  RC_ASSERT(static_cast<__int128>(dot.near) + static_cast<__int128>(dot.rest) ==
            exact);
}

TEST(ExactDot, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 3; ++i) {
      Vector3d a(1, 2, 3);
      a[i] = bad;
      EXPECT_TRUE(std::isnan(ExactDot(a, {1, 1, 1}).near)) << bad << i;
      EXPECT_TRUE(std::isnan(ExactDot({1, 1, 1}, a).near)) << bad << i;
    }
  }
  EXPECT_TRUE(std::isnan(ExactDot({1e200, 0, 0}, {1e200, 0, 0}).near));
}

}  // namespace
}  // namespace poise
