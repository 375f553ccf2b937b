// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that a ramp does not weaken the reaction to a push.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "poise/robot/control/stack.h"
#include "poise/robot/control/stand.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/judge.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr int kPush = 1000;  // Tick in which the push begins.

// Returns how far the center of mass moves after a push of 100 N for 0.15 s, m.
// `change` changes the stack before each tick.
double Push(double ramp, const std::function<void(int, Stack*)>& change) {
  const Robot robot = LoadHumanoid();
  Scenario scenario;
  scenario.duration = 3;
  scenario.control.ramp = ramp;
  poise::Push push;
  push.force = {0, 100, 0};
  scenario.pushes.push_back(push);
  ClosedLoop loop(robot, scenario);
  Judge judge(StandingHeight(robot));
  Stack& stack = loop.controller().stack();
  for (int i = 0; loop.time() < scenario.duration - 1e-6 && !judge.is_down();
       ++i) {
    change(i, &stack);
    loop.Tick();
    judge.Look(loop.observation());
  }
  const Verdict verdict = judge.Conclude();
  EXPECT_TRUE(verdict.recovered);
  return verdict.com_error_peak.y();
}

// Compares with changes that take effect at once, 47 mm, to 1 %.
void ExpectToDoAsMuch(const std::function<void(int, Stack*)>& change) {
  EXPECT_NEAR(Push(0.2, change) / Push(0, change), 1, 0.01);
}

TEST(Changes, AreEasedInWithTheRampOfTheScenario) {
  for (const double ramp : {0.0, 0.2}) {
    SCOPED_TRACE(ramp);
    Scenario scenario;
    scenario.control.ramp = ramp;
    ClosedLoop loop(LoadHumanoid(), scenario);
    Stack& stack = loop.controller().stack();
    loop.Tick();
    ASSERT_TRUE(stack.SetParameter("momentum", "kp", 31));
    loop.Tick();
    EXPECT_EQ(stack.is_eased(), ramp > 0);
  }
}

TEST(Changes, OfAGainAsThePushBegins) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    if (i == kPush) {
      EXPECT_TRUE(stack->SetParameter("momentum", "kp", 31));
    }
  });
}

TEST(Changes, OfAGainInEachTick) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("momentum", "kp", 30 + i % 2));
  });
}

TEST(Changes, OfALimitInEachTick) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("torque_limits", "scale",
                                    0.9 + 0.1 * std::sin(0.01 * i)));
  });
}

TEST(Changes, OfATaskThatGoesAsThePushBeginsAndComesBack) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    if (i == kPush) {
      EXPECT_TRUE(stack->Enable("posture", false));
    }
    if (i == kPush + 500) {
      EXPECT_TRUE(stack->Enable("posture", true));
    }
  });
}

}  // namespace
}  // namespace poise
