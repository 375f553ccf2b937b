// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "poise/python/python_controller.h"
#include "poise/robot/control/stack.h"

namespace poise {

/// The base class of a task that is written in Python.
struct PythonTaskBase {
  std::string name;
  std::vector<std::string> equalities, inequalities;  ///< Names of the rows.
  TaskSettings settings;
  std::string error;  ///< The last exception of rows(), or empty.
};

/// Returns a function that adds tasks of Python to a stack, see
/// ControllerOptions::add_tasks. Throws std::invalid_argument if an entry of
/// the list is not a Task.
std::function<void(Stack*)> TasksToAdd(pybind11::handle tasks);

}  // namespace poise
