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

/// Applies a `tasks:` section to a stack. Tasks are found by name:
///
///     tasks:
///       yaw: off                       # Or on.
///       momentum: {level: 3, kp: 40}    # Level, weight, on, any parameter.
///
/// Tasks and parameters without an entry do not change. `rank` is an alias of `level`.
///
/// @param file  of the section, for messages.
/// Throws std::invalid_argument("FILE:LINE: ...") if a task or a parameter does not
/// exist, or a value is out of its range.
void ApplyTasks(const YAML::Node& tasks, const std::string& file, Stack* stack);

/// Returns the links X of the tasks frame.X of a `tasks:` section, for
/// ControllerOptions::frames. Feet and unknown links are left out. Does not throw;
/// ApplyTasks() reports errors.
std::vector<std::string> FindTaskLinks(const YAML::Node& tasks,
                                       const Robot& robot);

/// Returns the section `tasks` with which ApplyTasks() restores this stack: switch,
/// level, weight and parameters of each task, to the last digit.
YAML::Node DescribeTasks(const Stack& stack);

/// Finds the links in a task set and in names of tasks to switch.
/// Throws std::invalid_argument about the file.
std::vector<std::string> FindTaskLinks(const std::string& set,
                                       const std::vector<std::string>& tasks,
                                       const Robot& robot);

/// Applies a task set to a stack: `default` changes nothing; `paper` is the table of
/// the paper's section 3; any other name is a YAML file with a section `tasks`.
/// Throws std::invalid_argument as ApplyTasks(), or about the file.
void ApplyTaskSet(const std::string& name, Stack* stack);

}  // namespace poise
