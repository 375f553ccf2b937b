// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/easing/ramp.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "poise/robot/control/easing/minimum_jerk.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;

// Minimum-jerk curve from 1 to 0 for s from 0 to 1.
double Falling(double s) { return 1 - MinimumJerk(s).value; }

TEST(Ramp, FollowsMinimumJerkCurveToZero) {
  Ramp ramp;
  ramp.Resize(2);
  ramp.set_duration(0.01);
  EXPECT_FALSE(ramp.is_on());
  ramp.Add(1, -3);
  for (int i = 0; i <= 10; ++i) {
    ASSERT_EQ(ramp.is_on(), i < 10) << i;
    EXPECT_EQ(ramp[0], 0);
    EXPECT_NEAR(ramp[1], -3 * Falling(0.1 * i), 1e-14) << i;  // Rounding.
    ramp.Advance(kDt);
  }
}

// Polynomial of degree 5 with the given value, rate and acceleration at 0, and
// zero value, rate and acceleration at T; computed from these six equations.
class Quintic {
 public:
  Quintic(const Eigen::Vector3d& begin, double T) {
    Eigen::Matrix<double, 6, 6> equations;
    equations << Row(0, 0), Row(0, 1), Row(0, 2),  //
        Row(T, 0), Row(T, 1), Row(T, 2);
    Eigen::Matrix<double, 6, 1> wanted;
    wanted << begin, Eigen::Vector3d::Zero();
    coefficients_ = equations.fullPivLu().solve(wanted);
  }
  double At(double t, int derivative) const {
    return Row(t, derivative).dot(coefficients_);
  }

 private:
  static Eigen::Matrix<double, 1, 6> Row(double t, int derivative) {
    Eigen::Matrix<double, 1, 6> row;
    for (int k = 0; k < 6; ++k) {
      double factor = 1;
      for (int d = 0; d < derivative; ++d) factor *= k - d;
      row[k] = k < derivative ? 0 : factor * std::pow(t, k - derivative);
    }
    return row;
  }
  Eigen::Matrix<double, 6, 1> coefficients_;
};

// After an addition, each number follows the minimum-jerk curve from its
// present value, rate and acceleration to zero, in a whole duration.
TEST(Ramp, RestartsSmoothlyAfterAddition) {
  constexpr double kDuration = 2;
  constexpr double kStep = 0.25;
  Ramp ramp;
  ramp.Resize(2);
  ramp.set_duration(kDuration);
  ramp.Add(0, 1);
  Quintic first({1, 0, 0}, kDuration);
  for (int i = 0; i < 3; ++i) ramp.Advance(kStep);
  EXPECT_NEAR(ramp[0], first.At(0.75, 0), 1e-14);
  ramp.Add(0, 2);
  ramp.Add(1, 5);
  const Quintic second(
      {first.At(0.75, 0) + 2, first.At(0.75, 1), first.At(0.75, 2)}, kDuration);
  for (int i = 0; i <= 8; ++i) {
    // Rounding, also of the LU decomposition in this test.
    EXPECT_NEAR(ramp[0], second.At(kStep * i, 0), 1e-12) << i;
    EXPECT_NEAR(ramp[1], 5 * Falling(kStep * i / kDuration), 1e-13) << i;
    ramp.Advance(kStep);
  }
  EXPECT_FALSE(ramp.is_on());
  EXPECT_EQ(ramp[0], 0);
}

// The characteristic polynomial is s^3 + 9/T s^2 + 36/T^2 s + 60/T^3. If c is
// added per second, the steady state is c T 36 / 60.
TEST(Ramp, FiltersAdditionsInEveryTick) {
  constexpr double kDuration = 0.2;
  Ramp ramp;
  ramp.Resize(1);
  ramp.set_duration(kDuration);
  for (int i = 0; i < 2000; ++i) {
    ramp.Add(0, 7 * kDt);
    ramp.Advance(kDt);
  }
  // The relative error of the discrete ticks is dt / T.
  EXPECT_NEAR(ramp[0], 7 * kDuration * 36 / 60,
              7 * kDuration * kDt / kDuration);
}

TEST(Ramp, IgnoresAdditionWithoutDuration) {
  Ramp ramp;
  ramp.Resize(1);
  ramp.Add(0, 1);
  EXPECT_FALSE(ramp.is_on());
  EXPECT_EQ(ramp[0], 0);
}

TEST(Ramp, ClearResetsValueAndRate) {
  Ramp ramp;
  ramp.Resize(1);
  ramp.set_duration(1);
  ramp.Add(0, 1);
  ramp.Advance(0.5);
  ramp.Clear();
  EXPECT_FALSE(ramp.is_on());
  ramp.Add(0, 1);  // Starts at rate 0 again.
  ramp.Advance(0.5);
  EXPECT_NEAR(ramp[0], 0.5, 1e-15);
}

}  // namespace
}  // namespace poise
