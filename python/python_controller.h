// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "poise/python/exclusive.h"
#include "poise/python/python_robot.h"
#include "poise/robot/control/command.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/tick_report.h"

namespace poise {

/// A controller, of its own or inside a simulation. Its settings and its
/// report may be used while no other thread runs a tick.
class PythonController {
 public:
  /// @param controller  keeps its owner alive.
  /// @param in_use      the mark of the owner.
  PythonController(std::shared_ptr<Controller> controller,
                   std::shared_ptr<InUse> in_use)
      : controller_(std::move(controller)), in_use_(std::move(in_use)) {}

  /// Returns the controller. Throws std::runtime_error while another thread
  /// runs a tick.
  Controller& get() const {
    in_use_->Check("this Controller");
    return *controller_;
  }
  InUse* in_use() const { return in_use_.get(); }

 private:
  std::shared_ptr<Controller> controller_;
  std::shared_ptr<InUse> in_use_;
};

/// Returns the stack of a controller as Python's Stack.
void BindStack(pybind11::module_* module);
/// Adds the class of Controller.report.
void BindTickReport(pybind11::module_* module);

using ControllerClass =
    pybind11::class_<PythonController, std::shared_ptr<PythonController>>;

/// Adds stack and report to Controller.
void AddStack(ControllerClass* controller);
void AddReport(ControllerClass* controller);

/// Returns "ok", "limit_relaxed", "truncated" or "fail_safe".
std::string NameOf(TickStatus status);

/// Returns the name of the status of a report, or "" before the first update.
std::string StatusOf(const TickReport& report);

}  // namespace poise
