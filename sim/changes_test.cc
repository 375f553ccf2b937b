// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that changes of the stack that are ramped in do not weaken the reaction
// to a push.
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

// Returns the peak error of the center of mass, m, after a push of 100 N that
// lasts 0.15 s. `change` may change the stack before each tick.
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

// The peak error must be within 1 % of the error without a ramp, 47 mm.
void ExpectToDoAsMuch(const std::function<void(int, Stack*)>& change) {
  EXPECT_NEAR(Push(0.2, change) / Push(0, change), 1, 0.01);
}

TEST(Changes, UseTheRampOfTheScenario) {
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

TEST(Changes, KeepTheRecoveryWhenAGainChangesAtThePush) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    if (i == kPush) {
      EXPECT_TRUE(stack->SetParameter("momentum", "kp", 31));
    }
  });
}

TEST(Changes, KeepTheRecoveryWhenAGainChangesEachTick) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("momentum", "kp", 30 + i % 2));
  });
}

TEST(Changes, KeepTheRecoveryWhenALimitChangesEachTick) {
  ExpectToDoAsMuch([](int i, Stack* stack) {
    EXPECT_TRUE(stack->SetParameter("torque_limits", "scale",
                                    0.9 + 0.1 * std::sin(0.01 * i)));
  });
}

TEST(Changes, KeepTheRecoveryWhenATaskIsOffDuringThePush) {
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
