// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "robot/control/stack.h"

namespace poise {

/// Changes a stack as a `tasks:` section says, by name of the task:
///
///     tasks:
///       yaw: off                       # Or on.
///       momentum: {rank: 3, kp: 40}    # Rank, weight, on, any parameter.
///
/// What is not named stays as it is.
///
/// @param file  of the section, for messages.
/// Throws std::invalid_argument("FILE:LINE: ...") about a task or a parameter
/// that is not there, or a value out of its range.
void ApplyTasks(const YAML::Node& tasks, const std::string& file, Stack* stack);

/// The section `tasks` that makes any stack of the same tasks this one: of each,
/// whether it is on, its rank, weight and parameters, to the last digit.
YAML::Node DescribeTasks(const Stack& stack);

/// Changes a stack to a task set: `default` (nothing to do); `paper`, the table
/// of the seed's section 3; else the section `tasks` of a YAML file.
/// Throws std::invalid_argument as ApplyTasks(), or about the file.
void ApplyTaskSet(const std::string& name, Stack* stack);

}  // namespace poise
