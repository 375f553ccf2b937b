// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <limits>
#include <string>
#include <vector>

#include "poise/python/arrays.h"
#include "poise/python/python_controller.h"
#include "poise/python/text.h"
#include "poise/robot/control/tick_report.h"
#include "poise/robot/finding.h"
#include "poise/sim/log/recorder.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

// A row of the stack in a report.
struct PythonRow {
  std::string name;
  int level;      // Priority level of the highest level with a multiplier.
  double amount;  // Multiplier, or residual.
  double slack;
};

// A copy of a report, with the names of its rows.
struct PythonReport {
  TickReport report;
  std::vector<PythonRow> active, lost;
  std::vector<std::string> tasks;
};

// Returns whether there has been an update: one that ends 'ok' takes at least
// one iteration of the solver.
bool IsFilled(const TickReport& report) {
  return report.status != TickStatus::kOk || report.iterations > 0;
}

PythonReport MakeReport(const PythonController& self) {
  const Controller& controller = self.get();
  const Stack& stack = controller.stack();
  PythonReport made{controller.report(), {}, {}, {}};
  if (!IsFilled(made.report)) {
    made.report.y.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  for (const ActiveRow& row : made.report.active) {
    made.active.push_back(
        {stack.RowName(row), row.pressing_level, row.multiplier, row.slack});
  }
  for (const LostRow& row : made.report.lost) {
    made.lost.push_back({stack.task(row.task).equality_names()[row.row],
                         stack.settings(row.task).level, row.amount, 0});
  }
  for (int i = 0; i < stack.num_tasks(); ++i) {
    made.tasks.push_back(stack.task(i).name());
  }
  return made;
}

py::dict Residuals(const PythonReport& self) {
  py::dict residuals;
  for (size_t i = 0; i < self.tasks.size(); ++i) {
    const TaskReport& task = self.report.tasks[i];
    if (task.enabled) residuals[py::str(self.tasks[i])] = task.residual;
  }
  return residuals;
}

void BindRow(py::module_* module) {
  py::class_<PythonRow> row(*module, "ReportRow", "A row of a TickReport.");
  row.def_readonly("name", &PythonRow::name,
                   "Its name as in the log: 'left_foot.cop.x_max'.");
  row.def_readonly("level", &PythonRow::level,
                   "Active: the highest priority level with a multiplier on "
                   "the row. Lost: the level of its task.");
  row.def_readonly("amount", &PythonRow::amount,
                   "Active: the absolute multiplier. Lost: the residual in the "
                   "unit of the row.");
  row.def_readonly("slack", &PythonRow::slack,
                   "The violation, in the scale of the row.");
  row.def("__repr__", [](const PythonRow& self) {
    return "<poise.ReportRow " + Repr(self.name) + ", amount " +
           PrintNumber(self.amount) + ">";
  });
}

}  // namespace

std::string NameOf(TickStatus status) {
  return std::string(StatusName(status));
}

std::string StatusOf(const TickReport& report) {
  return IsFilled(report) ? NameOf(report.status) : "";
}

void BindTickReport(py::module_* module) {
  BindRow(module);
  py::class_<PythonReport> report(*module, "TickReport",
                                  "The report on the last tick, a copy.");
  report.def_property_readonly(
      "status", [](const PythonReport& self) { return StatusOf(self.report); },
      "'ok', 'limit_relaxed', 'truncated' or 'fail_safe'; '' before the first "
      "update.");
  report.def("__repr__", [](const PythonReport& self) {
    return "<poise.TickReport, status '" + StatusOf(self.report) + "', " +
           Count(static_cast<std::ptrdiff_t>(self.active.size()),
                 "active row") +
           ">";
  });
  report.def_property_readonly(
      "fail_safe_reason",
      [](const PythonReport& self) {
        return std::string(ReasonName(self.report.fail_safe_reason));
      },
      "'' or 'state', 'clock', 'no_answer'.");
  report.def_property_readonly(
      "solver_status",
      [](const PythonReport& self) { return Name(self.report.solver_status); },
      "As Solution.status.");
  report.def_property_readonly(
      "iterations",
      [](const PythonReport& self) { return self.report.iterations; },
      "The solver's iterations.");
  report.def_property_readonly(
      "modelled_seconds",
      [](const PythonReport& self) { return self.report.modelled_seconds; },
      "The predicted time of the solve, s. It depends on the work alone.");
  report.def_property_readonly(
      "certificate",
      [](const PythonReport& self) { return self.report.certificate; },
      "The Certificate of the solution.");
  report.def_property_readonly(
      "gap", [](const PythonReport& self) { return self.report.gap; },
      "For each priority level, how far its cost may be above its optimum; inf "
      "below a level that was not solved, NaN if the solver has no such "
      "level.");
  report.def_property_readonly(
      "y",
      [](py::object self) {
        return View(self.cast<PythonReport&>().report.y, self);
      },
      "(nv + 12,) [vdot; wrench [moment; force] of each foot, about and in the "
      "axes of its contact frame]; NaN before the first update. Read-only.");
  report.def_property_readonly(
      "active", [](const PythonReport& self) { return self.active; },
      "The active inequalities, ReportRows.");
  report.def_property_readonly(
      "lost", [](const PythonReport& self) { return self.lost; },
      "The violated equalities, ReportRows.");
  report.def_property_readonly(
      "residuals", Residuals,
      "The norm of the residuals of each task that is on.");
}

void AddReport(ControllerClass* controller) {
  controller->def_property_readonly(
      "report", MakeReport, "The TickReport on the last update, a copy.");
}

}  // namespace poise
