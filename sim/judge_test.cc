// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace poise {
namespace {

// Returns the observation of a robot that stands still, at a time in s.
Observation Standing(double time) {
  Observation now;
  now.time = time;
  now.com_height = 1;
  now.feet.resize(2);
  return now;
}

// Returns the verdict over two seconds. `spoil` may change each observation.
template <typename Spoil>
Verdict Over(Spoil spoil) {
  Judge judge(1);
  for (int k = 0; k < 2000; ++k) {
    Observation now = Standing(k * 1e-3);
    spoil(&now);
    judge.Look(now);
  }
  return judge.Conclude();
}

// Returns the verdict over two seconds. set() changes only the tick at 1 s.
template <typename Set>
Verdict Once(Set set) {
  return Over([&set](Observation* now) {
    if (now->time == 1.0) set(now);
  });
}

TEST(Judge, StandingStillIsRecovered) {
  const Verdict verdict = Over([](Observation*) {});
  EXPECT_TRUE(verdict.recovered);
  EXPECT_FALSE(verdict.fell_at);
}

TEST(Judge, IsNotRecoveredWithoutObservations) {
  EXPECT_FALSE(Judge(1).Conclude().recovered);
}

TEST(Judge, LowCenterOfMassIsAFall) {
  EXPECT_TRUE(Once([](auto* now) { now->com_height = 0.601; }).recovered);
  const Verdict verdict = Once([](auto* now) { now->com_height = 0.599; });
  EXPECT_FALSE(verdict.recovered);
  EXPECT_EQ(*verdict.fell_at, 1);
  EXPECT_STREQ(verdict.fell_by, "the CoM sank below 60 % of its height");
}

TEST(Judge, TiltedBaseIsAFall) {
  EXPECT_TRUE(Once([](auto* now) { now->base_tilt = 1.047; }).recovered);
  EXPECT_FALSE(Once([](auto* now) { now->base_tilt = 1.048; }).recovered);
}

TEST(Judge, CountsNaNAsAFall) {
  EXPECT_FALSE(Once([](auto* now) {
                 now->com_height = std::numeric_limits<double>::quiet_NaN();
               }).recovered);
}

TEST(Judge, TiltedOrSlidingFootIsAFallButTheRunGoesOn) {
  EXPECT_TRUE(Once([](auto* now) { now->feet[1].tilt = 0.099; }).recovered);
  EXPECT_TRUE(Once([](auto* now) { now->feet[1].slide = 0.0299; }).recovered);
  const Verdict tilted = Once([](auto* now) { now->feet[1].tilt = 0.101; });
  EXPECT_FALSE(tilted.recovered);
  EXPECT_EQ(*tilted.fell_at, 1);
  EXPECT_STREQ(tilted.fell_by, "a foot tilted over 0.1 rad");
  EXPECT_EQ(tilted.foot_tilt_peak, 0.101);
  const Verdict slid = Once([](auto* now) { now->feet[0].slide = 0.0301; });
  EXPECT_FALSE(slid.recovered);
  EXPECT_EQ(slid.foot_slide_peak, 0.0301);
  Judge judge(1);
  Observation now = Standing(0);
  now.feet[0].slide = 1;
  judge.Look(now);
  EXPECT_FALSE(judge.is_down());
  now.com_height = 0.1;
  judge.Look(now);
  EXPECT_TRUE(judge.is_down());
}

TEST(Judge, OnlyTheMeanErrorAtTheEndCounts) {
  // A transient does not count, whatever its size.
  EXPECT_TRUE(Once([](auto* now) { now->com.x() = 0.3; }).recovered);
  // An oscillation of 25 mm has a mean of zero; a constant error does not.
  EXPECT_TRUE(Over([](auto* now) {
                now->com.x() = static_cast<int>(now->time * 1000 + 0.5) % 2
                                   ? 0.025
                                   : -0.025;
              }).recovered);
  const Verdict away = Over([](auto* now) { now->com_ref.y() = 0.0201; });
  EXPECT_FALSE(away.recovered);
  EXPECT_FALSE(away.fell_at);
  EXPECT_NEAR(away.com_error_final.y(), -0.0201,
              1e-12);  // Rounding of 500 terms.
  EXPECT_EQ(away.com_error_peak.y(), 0.0201);
  // The error counts in the plane: the norm of x and y, without z.
  EXPECT_FALSE(
      Over([](auto* now) { now->com.x() = now->com.y() = 0.0142; }).recovered);
  EXPECT_TRUE(Over([](auto* now) {
                now->com.x() = now->com.y() = 0.0141;
                now->com.z() = 1;
              }).recovered);
}

TEST(Judge, FinalErrorIsTheMeanOverTheLastHalfSecond) {
  const auto until = [](double time) {
    return Over([time](auto* now) {
      if (now->time < time) now->com.x() = 1;
    });
  };
  EXPECT_TRUE(until(1.499).recovered);
  EXPECT_FALSE(until(1.52).recovered);
}

TEST(Judge, KeepsThePeaks) {
  const Verdict verdict = Over([](auto* now) {
    if (now->time == 0.5) now->cop = {-0.03, 0.02};
    if (now->time == 0.7) now->cop.setConstant(std::nan(""));
    if (now->time == 0.6) now->com = {0.1, -0.2, 0.3};
  });
  EXPECT_EQ(verdict.cop_peak, Eigen::Vector2d(0.03, 0.02));
  EXPECT_EQ(verdict.com_error_peak, Eigen::Vector3d(0.1, 0.2, 0.3));
}

// A robot that may step must end at rest on both feet.
TEST(Judge, RobotThatStepsMustEndAtRestOnItsFeet) {
  const auto recovers = [](bool steps, double speed, bool is_down) {
    Judge judge(1, steps);
    for (int k = 0; k < 2000; ++k) {
      Observation now = Standing(k * 1e-3);
      if (k == 1900) now.com_velocity.x() = speed;
      if (k == 1900) now.feet[1].down = is_down;
      judge.Look(now);
    }
    return judge.Conclude().recovered;
  };
  EXPECT_TRUE(recovers(true, 0.019, true));
  EXPECT_FALSE(recovers(true, 0.021, true));
  EXPECT_FALSE(recovers(true, 0, false));
  EXPECT_TRUE(recovers(false, 0.021, false));
}
}  // namespace
}  // namespace poise
