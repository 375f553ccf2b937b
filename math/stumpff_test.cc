// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/stumpff.h"

#include <gtest/gtest.h>
#include <mpreal.h>

#include <limits>
#include <vector>

namespace poise {
namespace {

using mpfr::mpreal;

constexpr double kEps = std::numeric_limits<double>::epsilon();

// Returns cm by its series in 400 bits, independent of the code.
mpreal Series(int m, const mpreal& s) {
  mpreal term = 1 / mpfr::fac_ui(m), sum = term;
  for (int k = 1; abs(term) > abs(sum) * mpreal("1e-60"); ++k) {
    term *= -s / ((m + 2 * k - 1) * (m + 2 * k));
    sum += term;
  }
  return sum;
}

class StumpffTest : public testing::Test {
 protected:
  void SetUp() override { mpreal::set_default_prec(400); }
};

std::vector<double> AnglesBelowTheSwitch() {
  std::vector<double> angles{0, 1e-300, 1e-160, 1e-154, 1e-20};
  for (double a = 1e-16; a < 1.5; a *= 1.1) angles.push_back(a);
  for (double a = 1.54; a < 1.5811388; a += 1e-4) angles.push_back(a);
  return angles;
}

std::vector<double> AnglesAboveTheSwitch() {
  std::vector<double> angles{M_PI, 2 * M_PI - 1e-3, 3 * M_PI};
  for (double a = 1.5811389; a < 1.62; a += 1e-4) angles.push_back(a);
  for (double a = 1.62; a < 4 * M_PI; a += 0.01) angles.push_back(a);
  return angles;
}

TEST_F(StumpffTest, SeriesIsRightToTheLastDigits) {
  for (const double angle : AnglesBelowTheSwitch()) {
    SCOPED_TRACE(angle);
    const StumpffSeries c(angle * angle);
    const double values[] = {c.c1, c.c2, c.c3, c.c4, c.c5, c.c6};
    for (int m = 1; m <= 6; ++m) {
      const mpreal s = mpreal(angle) * angle, expected = Series(m, s);
      // One rounding of s and one of the sum; c1 is half of a number near 1.
      EXPECT_LE(abs((values[m - 1] - expected) / expected),
                m == 1 ? 2 * kEps : kEps)
          << m;
    }
  }
}

TEST_F(StumpffTest, ClosedFormIsRightToTheLastDigits) {
  for (const double angle : AnglesAboveTheSwitch()) {
    SCOPED_TRACE(angle);
    const Eigen::Vector3d w = angle * Eigen::Vector3d(2, -1, 2) / 3;
    const mpreal x = w[0], y = w[1], z = w[2], s = x * x + y * y + z * z;
    const Stumpff c = ComputeStumpff(w);
    const double values[] = {c.c1, c.c2, c.c3, c.dc1, c.dc2, c.dc3};
    for (int m = 1; m <= 3; ++m) {
      // Errors of sin θ / θ and (1 - cos θ) / θ²: the last digits of sine,
      // cosine and θ. c3, a quotient by s, has no larger error. A derivative
      // has m times this error.
      const double error = (2 + angle) * kEps;
      const double divisor = m == 1 ? angle : angle * angle;
      EXPECT_LE(abs(values[m - 1] - Series(m, s)) * divisor, error) << m;
      const mpreal derivative = m * Series(m + 2, s) - Series(m + 1, s);
      EXPECT_LE(abs(values[m + 2] - derivative) * s, m * error) << m;
    }
  }
}

TEST_F(StumpffTest, DerivativesBelowTheSwitchAreRight) {
  for (const double angle : AnglesBelowTheSwitch()) {
    SCOPED_TRACE(angle);
    const Stumpff c = ComputeStumpff({0, angle, 0});
    const StumpffSeries series(angle * angle);
    EXPECT_EQ(c.c1, series.c1);
    EXPECT_EQ(c.c2, series.c2);
    EXPECT_EQ(c.c3, series.c3);
    const double values[] = {c.dc1, c.dc2, c.dc3};
    for (int m = 1; m <= 3; ++m) {
      const mpreal s = mpreal(angle) * angle;
      const mpreal derivative = m * Series(m + 2, s) - Series(m + 1, s);
      // A difference; the larger term is twice the result.
      EXPECT_LE(abs(values[m - 1] / derivative - 1), 4 * kEps) << m;
    }
  }
}

// e and d by definition, and derivatives by the quotient rule.
struct Reference {
  mpreal e, d, de, dd;
};

Reference MakeReference(const mpreal& s) {
  const mpreal b = Series(2, s), c = Series(4, s);
  const mpreal db = 2 * c - Series(3, s);
  const mpreal ddb = 8 * Series(6, s) - 5 * Series(5, s) + c;
  Reference r;
  r.e = Series(1, s) / (2 * b);
  r.d = -db / (2 * b);
  r.dd = (db * db / b - ddb) / (2 * b);
  r.de = -2 * r.d - s * r.dd;
  return r;
}

TEST_F(StumpffTest, InverseIsRightToTheLastDigitsBelowTheSwitch) {
  for (const double angle : AnglesBelowTheSwitch()) {
    SCOPED_TRACE(angle);
    const InverseStumpff actual = ComputeInverseStumpff({0, 0, angle});
    const Reference r = MakeReference(mpreal(angle) * angle);
    EXPECT_LE(abs(actual.e / r.e - 1), 2 * kEps);
    // dc2 is half of the terms of its difference. The terms of dd are five
    // times dd and have three roundings plus twice those of dc2.
    EXPECT_LE(abs(actual.d / r.d - 1), 4 * kEps);
    EXPECT_LE(abs(actual.de / r.de - 1), 4 * kEps);
    EXPECT_LE(abs(actual.dd / r.dd - 1), 32 * kEps);
  }
}

TEST_F(StumpffTest, InverseIsRightToTheLastDigitsAboveTheSwitch) {
  for (const double angle : AnglesAboveTheSwitch()) {
    SCOPED_TRACE(angle);
    const InverseStumpff actual = ComputeInverseStumpff({angle, 0, 0});
    const mpreal s = mpreal(angle) * angle;
    const Reference r = MakeReference(s);
    // Condition of the cotangent, from which e differs by at least 1.
    const double turn = 2 * M_PI;
    const double condition =
        1 + angle / std::abs(angle - turn * std::max(1., round(angle / turn)));
    const mpreal e = std::max(1., std::abs(actual.e));
    const mpreal cosecant = s / 4 + r.e * r.e;  // (θ/2 / sin θ/2)².
    EXPECT_LE(abs(actual.e - r.e) / e, 2 * condition * kEps);
    EXPECT_LE(abs(actual.d - r.d) * s / e, 2 * condition * kEps);
    EXPECT_LE(abs(actual.de - r.de) * s / cosecant, 4 * condition * kEps);
    EXPECT_LE(abs(actual.dd - r.dd) * s * s / cosecant, 4 * condition * kEps);
  }
}

// Compares the derivative rule with central differences in 400 bits.
TEST_F(StumpffTest, DerivativeRuleHolds) {
  const mpreal h("1e-30");
  for (const double angle : {0.3, 1.0, 2.0, 5.0, 9.0}) {
    const mpreal s = mpreal(angle) * angle;
    const InverseStumpff c = ComputeInverseStumpff({0, angle, 0});
    const Reference above = MakeReference(s + h), below = MakeReference(s - h);
    // At most 100 roundings; the error of the difference itself is 1e-30.
    EXPECT_NEAR(c.de, ((above.e - below.e) / h).toDouble(), 1e-13) << angle;
    EXPECT_NEAR(c.dd, ((above.d - below.d) / h).toDouble(), 1e-13) << angle;
    for (int m = 1; m <= 4; ++m) {
      const mpreal slope = (Series(m, s + h) - Series(m, s - h)) / h;
      const mpreal rule = m * Series(m + 2, s) - Series(m + 1, s);
      EXPECT_LE(abs(slope - rule), mpreal("1e-28")) << angle << ' ' << m;
    }
  }
}

TEST_F(StumpffTest, NotFiniteGivesNan) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e160}) {
    SCOPED_TRACE(bad);
    const Stumpff c = ComputeStumpff({bad, 0, 0});
    EXPECT_TRUE(std::isnan(c.c1) && std::isnan(c.c2) && std::isnan(c.c3));
    EXPECT_TRUE(std::isnan(c.dc1) && std::isnan(c.dc2) && std::isnan(c.dc3));
    const InverseStumpff i = ComputeInverseStumpff({0, bad, 0});
    EXPECT_TRUE(std::isnan(i.e) && std::isnan(i.d));
    EXPECT_TRUE(std::isnan(i.de) && std::isnan(i.dd));
  }
}

}  // namespace
}  // namespace poise
