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

}  // namespace
}  // namespace poise
