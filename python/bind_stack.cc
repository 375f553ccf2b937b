// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/python/arguments.h"
#include "poise/python/python_controller.h"
#include "poise/python/text.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/finding.h"

namespace poise {

namespace py = pybind11;

namespace {

using Owner = std::shared_ptr<PythonController>;

struct PythonStack {
  Owner owner;
  Stack& get() const { return owner->get().stack(); }
};

// A task of a stack, by its index.
struct PythonTask {
  Owner owner;
  int index;
  Stack& stack() const { return owner->get().stack(); }
  const Task& task() const { return stack().task(index); }
  const TaskSettings& settings() const { return stack().settings(index); }
};

// The parameters of a task, as a mapping.
struct PythonParameters {
  PythonTask of;
};

[[noreturn]] void RefuseParameter(const Task& task, const std::string& name) {
  std::string names;
  for (const Parameter& parameter : task.parameters()) {
    names += (names.empty() ? "" : ", ") + parameter.name;
  }
  throw std::invalid_argument(
      "task '" + task.name() + "' has no parameter '" + name + "', " +
      (names.empty() ? "and none at all" : "must be one of " + names));
}

void SetParameterOf(const PythonParameters& self, py::handle key,
                    py::handle value) {
  const Task& task = self.of.task();
  const std::string name = AsText(key, "parameter");
  const double number = AsNumber(value, (task.name() + "." + name).c_str());
  if (self.of.stack().SetParameter(task.name(), name, number)) return;
  for (const Parameter& parameter : task.parameters()) {
    if (parameter.name != name) continue;
    throw std::invalid_argument(task.name() + "." + name + " is " +
                                PrintNumber(number) + ", must be from " +
                                PrintNumber(parameter.lower) + " to " +
                                PrintNumber(parameter.upper));
  }
  RefuseParameter(task, name);
}

double GetParameterOf(const PythonParameters& self, py::handle key) {
  const Task& task = self.of.task();
  const std::string name = AsText(key, "parameter");
  const auto value = self.of.stack().GetParameter(task.name(), name);
  if (!value) RefuseParameter(task, name);
  return *value;
}

py::dict AllParameters(const PythonParameters& self) {
  py::dict values;
  for (const Parameter& parameter : self.of.task().parameters()) {
    values[py::str(parameter.name)] = *parameter.value;
  }
  return values;
}

std::vector<std::string> TaskNames(const PythonStack& self) {
  std::vector<std::string> names;
  for (int i = 0; i < self.get().num_tasks(); ++i) {
    names.push_back(self.get().task(i).name());
  }
  return names;
}

PythonTask FindTask(const PythonStack& self, py::handle key) {
  const std::string name = AsText(key, "task");
  const auto index = self.get().Find(name);
  if (!index) throw std::invalid_argument(UnknownTask(name, self.get()));
  return {self.owner, *index};
}

void SetLevelOf(const PythonTask& self, py::handle value) {
  const std::string name = self.task().name() + ".level";
  const int level = AsInteger(value, name.c_str(), 1, Stack::kMaxLevel);
  if (self.stack().SetLevel(self.task().name(), level)) return;
  throw std::invalid_argument(name + " is " + std::to_string(level) +
                              ", must be from 1 to " +
                              std::to_string(Stack::kMaxLevel));
}

void SetWeightOf(const PythonTask& self, py::handle value) {
  const std::string name = self.task().name() + ".weight";
  const double weight = AsNumber(value, name.c_str());
  if (self.stack().SetWeight(self.task().name(), weight)) return;
  throw std::invalid_argument(name + " is " + PrintNumber(weight) +
                              ", must be from 1e-6 to 1e6");
}

void AddMapping(py::class_<PythonParameters>* parameters) {
  parameters->def("__len__", [](const PythonParameters& self) {
    return self.of.task().parameters().size();
  });
  parameters->def(
      "__contains__",
      [](const PythonParameters& self, py::handle name) {
        return AllParameters(self).contains(AsText(name, "parameter"));
      },
      py::arg("name"));
  parameters->def(
      "__iter__",
      [](const PythonParameters& self) {
        return py::iter(AllParameters(self));
      },
      "Iterates over the names.");
  for (const char* name : {"keys", "values", "items"}) {
    parameters->def(
        name,
        [name](const PythonParameters& self) {
          return py::object(AllParameters(self).attr(name)());
        },
        "Like the method of a dict with the same name; a copy.");
  }
}

void BindTask(py::module_* module) {
  py::class_<PythonParameters> parameters(
      *module, "Parameters",
      "The gains, margins and coefficients of a task: a mapping from names to "
      "numbers."
      "\n\n"
      ">>> stack = poise.Controller(poise.Robot.load()).stack\n"
      ">>> parameters = stack['momentum'].parameters\n"
      ">>> 'kp' in parameters, len(parameters) == len(list(parameters))\n"
      "(True, True)\n");
  parameters.def("__getitem__", GetParameterOf, py::arg("name"),
                 "Returns the value of a parameter.");
  parameters.def("__setitem__", SetParameterOf, py::arg("name"),
                 py::arg("value"),
                 "Sets a parameter; the value must be within its range.");
  AddMapping(&parameters);
  parameters.def("as_dict", AllParameters, "Returns all values, a copy.");
  parameters.def("__repr__", [](const PythonParameters& self) {
    const std::string values =
        self.of.owner->in_use()->is_set()
            ? "in use"
            : py::cast<std::string>(py::str(AllParameters(self)));
    return "<poise.Parameters, " + values + ">";
  });

  py::class_<PythonTask> task(
      *module, "StackTask",
      "A task of a Stack. A change takes effect at the next tick.");
  task.def_property_readonly(
      "name", [](const PythonTask& self) { return self.task().name(); },
      "The name of the task.");
  task.def_property(
      "enabled", [](const PythonTask& self) { return self.settings().enabled; },
      [](const PythonTask& self, py::handle value) {
        const std::string name = self.task().name() + ".enabled";
        const bool enabled = AsFlag(value, name.c_str());
        (void)self.stack().Enable(self.task().name(), enabled);
      },
      "Whether the task has rows in the hierarchy.");
  task.def_property(
      "level", [](const PythonTask& self) { return self.settings().level; },
      SetLevelOf, "The priority level, 1 is the highest, 8 the lowest.");
  task.def_property(
      "weight", [](const PythonTask& self) { return self.settings().weight; },
      SetWeightOf, "The weight within the level, 1e-6 to 1e6.");
  task.def_property_readonly(
      "parameters",
      [](const PythonTask& self) { return PythonParameters{self}; },
      "The Parameters of the task.");
  task.def("__repr__", [](const PythonTask& self) {
    if (self.owner->in_use()->is_set()) {
      return std::string("<poise.StackTask, in use>");
    }
    return "<poise.StackTask " + Repr(self.task().name()) + ", " +
           (self.settings().enabled ? "on" : "off") + ", level " +
           std::to_string(self.settings().level) + ", weight " +
           PrintNumber(self.settings().weight) + ">";
  });
}

}  // namespace

void BindStack(py::module_* module) {
  BindTask(module);
  py::class_<PythonStack> stack(
      *module, "Stack",
      "The tasks of a controller by name, each with its level."
      "\n\n"
      ">>> stack = poise.Controller(poise.Robot.load()).stack\n"
      ">>> stack['posture'].enabled = False\n"
      ">>> stack['momentum'].parameters['kp'] = 40.0\n"
      ">>> stack['momentum'].level, stack['momentum'].weight\n"
      "(4, 1.0)\n");
  stack.def_property_readonly("names", TaskNames, "The names of the tasks.");
  stack.def("__getitem__", FindTask, py::arg("name"),
            "Returns a StackTask by its name.");
  stack.def("__repr__", [](const PythonStack& self) {
    if (self.owner->in_use()->is_set()) {
      return std::string("<poise.Stack, in use>");
    }
    return "<poise.Stack, " + Count(self.get().num_tasks(), "task") + ">";
  });
  stack.def("__len__",
            [](const PythonStack& self) { return self.get().num_tasks(); });
  stack.def(
      "__contains__",
      [](const PythonStack& self, py::handle name) {
        return self.get().Find(AsText(name, "task")).has_value();
      },
      py::arg("name"));
  stack.def(
      "__iter__",
      [](const PythonStack& self) {
        return py::iter(py::cast(TaskNames(self)));
      },
      "Iterates over the names.");
  stack.def(
      "set_ramp",
      [](const PythonStack& self, py::handle seconds) {
        const double time = AsNumber(seconds, "seconds");
        if (self.get().set_ramp(time)) return;
        throw std::invalid_argument("seconds is " + PrintNumber(time) +
                                    ", must be finite and not negative");
      },
      py::arg("seconds"),
      "Later changes of tasks take effect gradually in this time, s.");
}

void AddStack(ControllerClass* controller) {
  controller->def_property_readonly(
      "stack", [](const Owner& self) { return PythonStack{self}; },
      "The Stack of the tasks.");
}

}  // namespace poise
