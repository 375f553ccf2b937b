// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/infinitesimals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace poise::infinitesimals {
namespace {

constexpr int kSize = 4;
using Number = std::array<double, kSize>;

// The coefficients are small whole numbers, and e = 2^-20. So the first nonzero
// coefficient, at least 1, outweighs the others.
constexpr double kInfinitesimal = 1.0 / (1 << 20);

// The number with this e, which stands for all smaller ones.
double Value(const Number& m) {
  double value = 0;
  for (int k = kSize - 1; k >= 0; --k) value = m[k] + kInfinitesimal * value;
  return value;
}

class DrawNumber {
 public:
  explicit DrawNumber(int seed) : numbers_(seed) {}
  // Half of all numbers begin with zeros.
  Number operator()() {
    Number m{};
    for (int k = std::max(zeros_(numbers_), 0); k < kSize; ++k)
      m[k] = whole_(numbers_);
    return m;
  }
  // A number of this sign.
  Number operator()(int sign) {
    Number m = (*this)();
    while (Value(m) == 0) m = (*this)();
    if ((Value(m) > 0) != (sign > 0)) {
      for (double& entry : m) entry = -entry;
    }
    return m;
  }

 private:
  std::mt19937 numbers_;
  std::uniform_int_distribution<int> whole_{-9, 9}, zeros_{-2, 3};
};

TEST(Infinitesimals, OrdersNumbersAsTheirValues) {
  DrawNumber draw(1);
  for (int i = 0; i < 2000; ++i) {
    const Number a = draw(), b = i % 10 == 0 ? a : draw();
    const double value = Value(a);
    EXPECT_EQ(Sign(a.data(), kSize), (value > 0) - (value < 0));
    EXPECT_EQ(IsLess(a.data(), b.data(), kSize), value < Value(b));
  }
}

// The time of the zero by division of the values. The coefficients that are
// left out have the order kSize - lowest, and each is below 19 times the sum of
// those before: the numerators and the other coefficients of the denominator
// are at most 18. So four of them add up to less than 18 * 19^4 = 2.3e6.
TEST(Infinitesimals, FindsTheZeroAtTheQuotientOfTheValues) {
  DrawNumber draw(2);
  for (int i = 0; i < 2000; ++i) {
    const Number m = draw(1), end = draw(-1);
    Number rest, t;
    FindZero(m.data(), end.data(), kSize, rest.data(), t.data());
    EXPECT_EQ(FirstOfZero(m.data(), end.data()), t[0]);
    int lowest = 0;
    while (m[lowest] == end[lowest]) ++lowest;
    const double expected = Value(m) / (Value(m) - Value(end));
    const double left_out = 2.4e6 * std::pow(kInfinitesimal, kSize - lowest);
    // 1e-14: a few operations on numbers of at most 1.
    EXPECT_NEAR(Value(t), expected, 1e-14 + left_out);
    // It lies between the two ends.
    EXPECT_GE(Sign(t.data(), kSize), 0);
    EXPECT_LE(t[0], 1);
  }
}

// At the time of its zero a number is zero in all coefficients that the time
// has.
TEST(Infinitesimals, ApproachesZeroAtTheTimeOfTheZero) {
  DrawNumber draw(3);
  for (int i = 0; i < 2000; ++i) {
    const Number m = draw(1), end = draw(-1);
    Number rest, t, now = m;
    FindZero(m.data(), end.data(), kSize, rest.data(), t.data());
    Approach(t.data(), end.data(), kSize, now.data());
    // A few eps of the terms: coefficient k of t is below 19^k, times at
    // most 18.
    for (int k = 0; k < kSize; ++k) {
      EXPECT_NEAR(now[k], 0, 1e-15 * std::pow(19, k + 1)) << k;
    }
  }
}

// The coefficients are those of a product of polynomials; whole numbers and
// quarters are exact. One time in three is a number without infinitesimal part.
TEST(Infinitesimals, ApproachesLinearlyInTime) {
  DrawNumber draw(4);
  for (int i = 0; i < 2000; ++i) {
    const Number m = draw(), end = draw();
    Number t = draw(), now = m;
    for (double& entry : t) entry /= 4;
    if (i % 3 == 0) std::fill(t.begin() + 1, t.end(), 0);
    Approach(t.data(), end.data(), kSize, now.data());
    for (int k = 0; k < kSize; ++k) {
      double expected = m[k];
      for (int l = 0; l <= k; ++l) expected += t[l] * (end[k - l] - m[k - l]);
      EXPECT_EQ(now[k], expected) << k;
    }
  }
}

// 0.1 + 0.2 (0.3 - 0.8) is rounding of zero.
TEST(Infinitesimals, SetsRoundingToZero) {
  double m = 0.1, end = -0.4;
  const double t = 0.2;
  Approach(&t, &end, 1, &m);
  EXPECT_EQ(m, 0);
}

}  // namespace
}  // namespace poise::infinitesimals
