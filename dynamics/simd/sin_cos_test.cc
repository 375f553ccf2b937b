// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/simd/sin_cos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace poise {
namespace {

// Returns the error in units of the last place of the exact value.
double Ulps(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double ulp =
      std::nextafter(std::abs(rounded), INFINITY) - std::abs(rounded);
  return static_cast<double>(std::abs(value - exact)) / ulp;
}

// Returns the largest error of sines and cosines of the angles.
double LargestUlps(const std::vector<double>& x) {
  const int n = static_cast<int>(x.size());
  std::vector<double> sine(n), cosine(n);
  SinCos(x.data(), n, sine.data(), cosine.data());
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    const long double angle = x[i];
    largest = std::max({largest, Ulps(sine[i], std::sin(angle)),
                        Ulps(cosine[i], std::cos(angle))});
  }
  return largest;
}

TEST(SinCos, IsExactToOneUlp) {
  std::vector<double> x;
  for (int i = -20000; i <= 20000; ++i) x.push_back(0.001 * i);
  for (int i = -20000; i <= 20000; ++i) x.push_back(0.5000003 * i);
  EXPECT_LT(LargestUlps(x), 0.85);  // Measured: 0.81.
}

TEST(SinCos, KeepsSmallAngles) {
  std::vector<double> x;
  for (double angle = 1e-300; angle < 1; angle *= 7) {
    x.push_back(angle);
    x.push_back(-angle);
  }
  EXPECT_LT(LargestUlps(x), 0.85);  // Measured: 0.81.
}

TEST(SinCos, KeepsDigitsNearMultiplesOfARightAngle) {
  // The double nearest to k pi/2 differs from it by a tiny number, which is the
  // sine or cosine.
  std::vector<double> x;
  for (int k = -6000; k <= 6000; ++k) x.push_back(k * (M_PI / 2));
  EXPECT_LT(LargestUlps(x), 0.85);  // Measured: 0.81.
}

TEST(SinCos, HandlesHugeAngles) {
  EXPECT_LT(LargestUlps({10000, 10001, -10001, 1e5, -1e9, 1e15, 1e300}), 0.85);
}

TEST(SinCos, IsExactAtZero) {
  const double zero = 0;
  double sine = 1, cosine = 0;
  SinCos(&zero, 1, &sine, &cosine);
  EXPECT_EQ(sine, 0);
  EXPECT_EQ(cosine, 1);
}

TEST(SinCos, ReturnsNaNForNonfiniteAngles) {
  const double x[] = {std::numeric_limits<double>::quiet_NaN(),
                      std::numeric_limits<double>::infinity()};
  double sine[2], cosine[2];
  SinCos(x, 2, sine, cosine);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(std::isnan(sine[i]));
    EXPECT_TRUE(std::isnan(cosine[i]));
  }
}

}  // namespace
}  // namespace poise
