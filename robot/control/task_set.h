// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the error message for a task name that is not in the stack, with the
/// valid names.
std::string UnknownTask(const std::string& name, const Stack& stack);

/// Applies a section `tasks` to a stack, by the names of the tasks:
///
///     tasks:
///       yaw: off                       # Or on.
///       momentum: {level: 3, kp: 40}    # Level, weight, on, any parameter.
///
/// Tasks and fields that are not named stay unchanged. `rank` is an alias of
/// `level`.
///
/// @param file  file of the section, for messages.
/// Throws std::invalid_argument("FILE:LINE: ...") if a task or a parameter is
/// unknown, or a value is out of its range.
void ApplyTasks(const YAML::Node& tasks, const std::string& file, Stack* stack);

/// Returns the links X of the tasks frame.X in a section `tasks`, for
/// ControllerOptions::frames. Feet are left out (they have their task already),
/// and so are links that the robot does not have. Does not report errors in the
/// section: ApplyTasks() does.
std::vector<std::string> FindTaskLinks(const YAML::Node& tasks,
                                       const Robot& robot);

/// Returns a section `tasks` with all settings of a stack: of each task whether
/// the task is on, its level, weight and parameters, to the last digit. Applied
/// to a stack with the same tasks, the section gives the same settings.
YAML::Node DescribeTasks(const Stack& stack);

/// Returns the links X of the tasks frame.X in a task set (see ApplyTaskSet())
/// and in a list of task names. Throws std::invalid_argument if the file of the
/// set cannot be read.
std::vector<std::string> FindTaskLinks(const std::string& set,
                                       const std::vector<std::string>& tasks,
                                       const Robot& robot);

/// Applies a task set to a stack: `default` changes nothing; `paper` is the
/// table of section 3 of the paper; any other name is a YAML file with a
/// section `tasks`. Throws std::invalid_argument like ApplyTasks(), or if the
/// file cannot be read.
void ApplyTaskSet(const std::string& name, Stack* stack);

}  // namespace poise
