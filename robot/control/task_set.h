// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the error message for a name that no task of a stack has.
std::string UnknownTask(const std::string& name, const Stack& stack);

/// Changes a stack as a `tasks:` section says, by name of the task:
///
///     tasks:
///       yaw: off                       # Or on.
///       momentum: {level: 3, kp: 40}    # Level, weight, on, any parameter.
///
/// Tasks and parameters without an entry do not change. `rank` is an alias of `level`.
///
/// @param file  of the section, for messages.
/// Throws std::invalid_argument("FILE:LINE: ...") about a task or a parameter
/// that is not there, or a value out of its range.
void ApplyTasks(const YAML::Node& tasks, const std::string& file, Stack* stack);

/// The links X of a `tasks:` section's tasks frame.X, for
/// ControllerOptions::frames: those that the robot has, but no foot has the name
/// of. Throws nothing about what is wrong: ApplyTasks() does.
std::vector<std::string> FindTaskLinks(const YAML::Node& tasks,
                                       const Robot& robot);

/// The section `tasks` that makes any stack of the same tasks this one: of each,
/// whether it is on, its level, weight and parameters, to the last digit.
YAML::Node DescribeTasks(const Stack& stack);

/// Finds the links in a task set and in names of tasks to switch.
/// Throws std::invalid_argument about the file.
std::vector<std::string> FindTaskLinks(const std::string& set,
                                       const std::vector<std::string>& tasks,
                                       const Robot& robot);

/// Changes a stack to a task set: `default` (nothing to do); `paper`, the table
/// of the paper's section 3; else the section `tasks` of a YAML file.
/// Throws std::invalid_argument as ApplyTasks(), or about the file.
void ApplyTaskSet(const std::string& name, Stack* stack);

}  // namespace poise
