// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <memory>

#include "poise/robot/control/controller.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/robot.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Makes the controller of a scenario. It believes in the wrong masses, and
/// knows the reduced torques, of the scenario. Throws InputError of the field
/// that names a task that the robot does not have, or of "robot" if the robot
/// cannot be controlled. Throws Refusal about a file.
/// @param add_tasks  see ControllerOptions::add_tasks.
std::unique_ptr<Controller> MakeController(
    const Robot& robot, const Scenario& scenario,
    const std::function<void(Stack*)>& add_tasks);

}  // namespace poise
