// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/recorded_ticks.h"

#include "poise/sim/closed_loop.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Start of the push, and recorded time before it, s.
constexpr double kStart = 0.1, kLead = 0.05;

}  // namespace

RecordedTicks RecordTicks(const RecordingConditions& conditions) {
  const Robot robot = LoadHumanoid();
  Scenario scenario;
  scenario.duration = conditions.end;
  Push push;
  push.force = {0, conditions.push_force, 0};
  push.start = kStart;
  push.duration = 0.15;
  scenario.pushes = {push};
  if (!conditions.has_limits) {
    scenario.control.without = {"torque_limits", "joint_limits"};
  }
  ClosedLoop loop(robot, scenario);
  RecordedTicks recorded{loop.controller().stack().capacity(), {}};
  while (loop.time() < conditions.end) {
    if (conditions.has_limits && loop.time() >= kStart) {
      (void)loop.controller().stack().SetParameter("torque_limits", "scale",
                                                   conditions.torque_scale);
    }
    loop.Tick();
    if (loop.time() > kStart - kLead) {
      recorded.ticks.push_back(loop.controller().hierarchy());
    }
  }
  return recorded;
}

}  // namespace poise
