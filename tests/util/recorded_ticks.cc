// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/recorded_ticks.h"

#include "poise/sim/closed_loop.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Start of the push and of the reduced torque, s.
constexpr double kStart = 0.1;

Scenario MakePush(const RecordingConditions& conditions) {
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
  return scenario;
}

// As VisitTicks(), with the closed loop.
void VisitLoop(const RecordingConditions& conditions,
               const std::function<void(const ClosedLoop&)>& visit) {
  const bool is_push = !conditions.scenario;
  ClosedLoop loop(conditions.robot ? *conditions.robot : LoadHumanoid(),
                  is_push ? MakePush(conditions) : *conditions.scenario);
  while (loop.time() < conditions.end) {
    if (is_push && conditions.has_limits && loop.time() >= kStart) {
      (void)loop.controller().stack().SetParameter("torque_limits", "scale",
                                                   conditions.torque_scale);
    }
    loop.Tick();
    if (loop.time() > conditions.begin) visit(loop);
  }
}

}  // namespace

void VisitTicks(const RecordingConditions& conditions,
                const std::function<void(const Controller&)>& visit) {
  VisitLoop(conditions,
            [&](const ClosedLoop& loop) { visit(loop.controller()); });
}

RecordedTicks RecordTicks(const RecordingConditions& conditions) {
  RecordedTicks recorded;
  VisitTicks(conditions, [&](const Controller& controller) {
    if (recorded.ticks.empty()) {
      recorded.capacity = controller.stack().capacity();
    }
    recorded.ticks.push_back(controller.hierarchy());
  });
  return recorded;
}

std::vector<State> RecordStates(const RecordingConditions& conditions) {
  std::vector<State> states;
  VisitLoop(conditions, [&](const ClosedLoop& loop) {
    const PlantState& start = loop.record().start;
    states.push_back({start.time, start.q, start.v});
  });
  return states;
}

}  // namespace poise
