// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/push.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "poise/tests/util/simple_robots.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Returns the impulse of a push of 1 N, in steps of dt over ten seconds, N s.
double Impulse(const Push& push, double dt) {
  double impulse = 0;
  const int steps = static_cast<int>(std::lround(10 / dt));
  for (int k = 0; k < steps; ++k) {
    impulse += dt * MeanOfProfile(push, k * dt, dt);
  }
  return impulse;
}

TEST(Push, ImpulseDoesNotDependOnTheStep) {
  for (const PushProfile profile :
       {PushProfile::kBox, PushProfile::kHalfSine, PushProfile::kImpulse}) {
    Push push;
    push.profile = profile;
    push.start = 1.00037;
    push.duration = 0.1537;
    for (const double dt : {1e-3, 5e-3, 1e-2}) {
      SCOPED_TRACE(dt);
      EXPECT_NEAR(Impulse(push, dt), ProfileIntegral(push), Rounding(1, 10000));
    }
  }
}

TEST(Push, IntegratesEachProfile) {
  Push push;
  push.duration = 0.2;
  EXPECT_DOUBLE_EQ(ProfileIntegral(push), 0.2);
  push.profile = PushProfile::kImpulse;
  EXPECT_DOUBLE_EQ(ProfileIntegral(push), 0.2);
  push.profile = PushProfile::kHalfSine;
  EXPECT_DOUBLE_EQ(ProfileIntegral(push), 0.4 / M_PI);
  // Half of the integral is reached in the middle, and 0 at the start.
  EXPECT_NEAR(ProfileIntegral(push, push.start + 0.5 * push.duration),
              0.2 / M_PI, Rounding(push.start, 2));
  EXPECT_EQ(ProfileIntegral(push, push.start), 0);
  EXPECT_NEAR(ProfileIntegral(push, push.start + push.duration), 0.4 / M_PI,
              Rounding(push.start, 2));
}

TEST(Push, HalfSinePeaksInTheMiddle) {
  Push push;
  push.profile = PushProfile::kHalfSine;
  push.start = 1;
  push.duration = 0.2;
  // The mean over dt around the peak is 1 - (pi dt / T)^2 / 24.
  EXPECT_NEAR(MeanOfProfile(push, 1.1 - 5e-4, 1e-3), 1, 1.1e-5);
  EXPECT_NEAR(MeanOfProfile(push, 1.05 - 5e-4, 1e-3), std::sqrt(0.5), 1.1e-5);
  EXPECT_EQ(MeanOfProfile(push, 0.9, 0.05), 0);
  EXPECT_EQ(MeanOfProfile(push, 1.25, 0.05), 0);
}

TEST(Push, ImpulseActsInOneStep) {
  Push push;
  push.profile = PushProfile::kImpulse;
  push.start = 0.3;  // 300 * 1e-3 is not 0.3 in binary.
  push.duration = 0.1;
  int steps = 0;
  for (int k = 0; k < 1000; ++k) {
    if (MeanOfProfile(push, k * 1e-3, 1e-3) > 0) ++steps;
  }
  EXPECT_EQ(steps, 1);
}

TEST(Push, ActsAtTheCenterOfMassInTheWorldsAxes) {
  Robot robot = MakeBlock({0.1, 0.2, 0.3}, 5);
  Push push;
  push.force = {1, 2, 3};
  push.moment = {4, 5, 6};
  push.start = 0;
  const PushOnRobot aimed(robot, push);
  const Eigen::Matrix3d R_WB =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto force = aimed.At(0, 1e-3, R_WB);
  ASSERT_TRUE(force);
  EXPECT_EQ(force->body, 0);
  EXPECT_TRUE(force->p_BoQ_B.isZero());
  EXPECT_TRUE(force->force_W.isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE(force->torque_W.isApprox(Eigen::Vector3d(4, 5, 6)));
  EXPECT_FALSE(aimed.At(1, 1e-3, R_WB));
}

TEST(Push, TurnsWithItsLinkInTheLinkFrame) {
  Robot robot = MakeBlock({0.1, 0.2, 0.3}, 5);
  Push push;
  push.link = "block";
  push.point = Eigen::Vector3d(0.1, 0, 0);
  push.frame = PushFrame::kLink;
  push.force = {1, 2, 3};
  push.moment = {4, 5, 6};
  push.start = 0;
  const Eigen::Matrix3d R_WB =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto force = PushOnRobot(robot, push).At(0, 1e-3, R_WB);
  ASSERT_TRUE(force);
  EXPECT_TRUE(force->p_BoQ_B.isApprox(Eigen::Vector3d(0.1, 0, 0)));
  EXPECT_TRUE(force->force_W.isApprox(Eigen::Vector3d(-2, 1, 3)));
  EXPECT_TRUE(force->torque_W.isApprox(Eigen::Vector3d(-5, 4, 6)));
}

std::string MessageFor(const Push& push) {
  try {
    PushOnRobot(MakeBall(0.1, 1), push);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Push, RejectsInvalidPushes) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(MessageFor({}), "");
  Push push;
  push.link = "elbow";
  EXPECT_EQ(MessageFor(push),
            "link 'elbow' is unknown, must be a link of robot 'simple'");
  push = {};
  push.duration = -1;
  EXPECT_EQ(MessageFor(push),
            "duration of a push is -1.000000, must be at least 0 s");
  for (const double value : {kNan, kInfinity}) {
    push = {};
    push.duration = value;
    EXPECT_NE(MessageFor(push), "");
    push = {};
    push.start = value;
    EXPECT_NE(MessageFor(push), "");
    push = {};
    push.point = Eigen::Vector3d(0, value, 0);
    EXPECT_NE(MessageFor(push), "");
    push = {};
    push.moment.z() = value;
    EXPECT_NE(MessageFor(push), "");
  }
  push = {};
  push.force.x() = kNan;
  EXPECT_EQ(MessageFor(push), "force of a push is nan, must be finite");
}

TEST(Push, KnowsTheTimeAfterTheLastPush) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(TimeAfterPushes({}, 5), kInfinity);
  Push push;                                         // From 1 s to 1.15 s.
  EXPECT_EQ(TimeAfterPushes({push}, 5), kInfinity);  // Without a force.
  push.moment.z() = 1;
  Push never = push;
  never.duration = 0;
  EXPECT_EQ(TimeAfterPushes({never}, 5), kInfinity);
  // Tolerance: differences of times up to 5 s are rounded by 1e-15 s.
  EXPECT_NEAR(TimeAfterPushes({push}, 5), 3.85, 1e-12);
  EXPECT_NEAR(TimeAfterPushes({push}, 1.1), -0.05, 1e-12);
  EXPECT_EQ(TimeAfterPushes({push}, 1), kInfinity);
  Push later = push;
  later.start = 2;
  EXPECT_NEAR(TimeAfterPushes({later, push}, 5), 2.85, 1e-12);
  later.profile = PushProfile::kImpulse;  // All of it acts at once.
  EXPECT_NEAR(TimeAfterPushes({push, later}, 5), 3, 1e-12);
}

}  // namespace
}  // namespace poise
