// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/eased_vector.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace poise {
namespace {

using Eigen::Vector3d;

TEST(EasedVector, IsAtItsTargetsBeforeAndAfterAChange) {
  const Vector3d start(1, -2, 3), target(-1, 0, 4);
  EasedVector vector(start);
  EXPECT_EQ(vector.At(0).value, start);
  vector.GoTo(target, 2, 0.5);
  for (const double time : {0.0, 2.0, 2.5, 9.0}) {
    const EasedVector::Motion motion = vector.At(time);
    EXPECT_EQ(motion.value, time < 2.25 ? start : target) << time;
    EXPECT_EQ(motion.rate, Vector3d::Zero()) << time;
    EXPECT_EQ(motion.acceleration, Vector3d::Zero()) << time;
  }
}

TEST(EasedVector, HasTheDerivativesOfItsValue) {
  EasedVector vector(Vector3d(1, -2, 3));
  vector.GoTo({-1, 0, 4}, 2, 0.5);
  constexpr double kStep = 1e-4;  // s.
  for (int i = 1; i < 10; ++i) {
    const double time = 2 + 0.05 * i;
    const EasedVector::Motion before = vector.At(time - kStep);
    const EasedVector::Motion after = vector.At(time + kStep);
    const EasedVector::Motion now = vector.At(time);
    // The error is kStep^2 / 6 times the third derivative of the value, at most
    // 60 |way| / over^3 = 1440, and of the rate, at most 360 |way| / over^4 =
    // 17280. The rates are below 20 1/s, so rounding is below 20 * 2e-16 /
    // kStep = 4e-11.
    EXPECT_LT(((after.value - before.value) / (2 * kStep) - now.rate).norm(),
              kStep * kStep / 6 * 1440 + 1e-10);
    EXPECT_LT(
        ((after.rate - before.rate) / (2 * kStep) - now.acceleration).norm(),
        kStep * kStep / 6 * 17280 + 1e-10);
  }
}

// A change that begins during another one does not jump.
TEST(EasedVector, IsContinuousIfTheTargetChangesOnTheWay) {
  const Vector3d start(1, -2, 3), first(-1, 0, 4), second(2, 2, 2);
  for (const double at : {2.1, 2.3, 2.45}) {
    EasedVector vector(start);
    vector.GoTo(first, 2, 0.5);
    const EasedVector::Motion before = vector.At(at);
    vector.GoTo(second, at, 0.8);
    const EasedVector::Motion after = vector.At(at);
    EXPECT_EQ(after.value, before.value);
    // Rates are below 20 1/s and accelerations below 200 1/s2; each is
    // multiplied by the time and divided by it again.
    EXPECT_LT((after.rate - before.rate).norm(), 20 * 1e-15);
    EXPECT_LT((after.acceleration - before.acceleration).norm(), 200 * 1e-15);
    const EasedVector::Motion end = vector.At(at + 0.8);
    // The terms of the polynomials are below 100.
    EXPECT_LT((end.value - second).norm(), 100 * 1e-14);
    EXPECT_LT(end.rate.norm(), 100 * 1e-14);
    EXPECT_LT(end.acceleration.norm(), 1000 * 1e-14);
    constexpr double kStep = 1e-5;  // s.
    for (int i = 1; i < 8; ++i) {
      const double time = at + 0.1 * i;
      const EasedVector::Motion low = vector.At(time - kStep);
      const EasedVector::Motion high = vector.At(time + kStep);
      const EasedVector::Motion now = vector.At(time);
      // The error is kStep^2 / 6 times a third derivative, which is below
      // 1e6 for the value and the rate, and rounding, 20 * 2e-16 / kStep.
      EXPECT_LT(((high.value - low.value) / (2 * kStep) - now.rate).norm(),
                1e-4);
      EXPECT_LT(
          ((high.rate - low.rate) / (2 * kStep) - now.acceleration).norm(),
          1e-4);
    }
  }
}

}  // namespace
}  // namespace poise
