// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/make_controller.h"

#include <chrono>
#include <string>
#include <vector>

#include "poise/robot/control/task_set.h"
#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"

namespace poise {
namespace {

// Returns the robot of the controller, with the wrong masses of the scenario.
Robot MakeBelievedRobot(const Robot& robot, const Scenario& scenario) {
  Robot believed = robot;
  believed.model.tree =
      robot.model.tree.WithScaledInertias(1 + scenario.control.mass_error);
  for (JointLimits& limits : believed.model.limits) {
    limits.effort *= scenario.plant.torque_scale;
    if (scenario.plant.joint_damping) continue;
    limits.damping = 0;  // The plant's joints have none.
    limits.friction = 0;
  }
  return believed;
}

void Switch(const std::vector<std::string>& tasks, bool on, Stack* stack) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (stack->Enable(tasks[i], on)) continue;
    throw InputError(EntryPath(on ? "tasks.with" : "tasks.without", i),
                     UnknownTask(tasks[i], *stack));
  }
}

}  // namespace

std::unique_ptr<Controller> MakeController(
    const Robot& robot, const Scenario& scenario,
    const std::function<void(Stack*)>& add_tasks) {
  const Robot believed = MakeBelievedRobot(robot, scenario);
  const ControlSettings& settings = scenario.control;
  ControllerOptions options;
  options.add_tasks = add_tasks;
  options.dt = settings.dt;
  options.friction = settings.friction;
  options.inscribed = settings.inscribed;
  options.feedforward = settings.feedforward;
  options.weighted = settings.weighted;
  options.drag_compensation = settings.drag_compensation;
  if (settings.budget_clock && settings.budget_us == 0) {
    throw InputError::OfValue("control.budget_clock",
                              " is true, must come with ", "control.budget_us",
                              " above 0 us");
  }
  if (settings.budget_clock) {
    options.max_seconds = 1e-6 * settings.budget_us;
    options.now = [] {
      const auto now = std::chrono::steady_clock::now().time_since_epoch();
      return std::chrono::duration<double>(now).count();
    };
  } else {
    options.max_modelled_seconds = 1e-6 * settings.budget_us;
  }
  std::vector<std::string> switched = settings.with;
  switched.insert(switched.end(), settings.without.begin(),
                  settings.without.end());
  const char* set = "tasks.set";
  options.frames = MakeOfField(
      set, [&] { return FindTaskLinks(settings.tasks, switched, believed); });
  auto controller = MakeOfField(
      "robot", [&] { return std::make_unique<Controller>(believed, options); });
  MakeOfField(set, [&] { ApplyTaskSet(settings.tasks, &controller->stack()); });
  Switch(settings.without, false, &controller->stack());
  Switch(settings.with, true, &controller->stack());
  if (!controller->stack().set_ramp(settings.ramp)) {
    throw InputError::OfValue("control.ramp",
                              " is " + PrintNumber(settings.ramp) +
                                  ", must be finite and not negative");
  }
  return controller;
}

}  // namespace poise
