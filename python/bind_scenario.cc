// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/python/arguments.h"
#include "poise/python/bind.h"
#include "poise/python/make_push.h"
#include "poise/python/python_robot.h"
#include "poise/python/text.h"
#include "poise/robot/finding.h"
#include "poise/sim/scenario.h"

namespace poise {

namespace py = pybind11;

namespace {

std::filesystem::path Ours() { return DataFolder() / "sim/scenarios"; }

std::vector<std::string> ScenarioNames() {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(Ours())) {
    names.insert(file.path().stem().string());
  }
  return {names.begin(), names.end()};
}

// Returns the file of a scenario of Poise with this name, or else the file.
std::filesystem::path FindScenario(const std::string& name) {
  std::error_code too_long;  // Too long for the name of a file.
  const std::filesystem::path ours = Ours() / (name + ".yaml");
  if (name.find('/') == std::string::npos &&
      std::filesystem::exists(ours, too_long)) {
    return ours;
  }
  if (std::filesystem::is_regular_file(name, too_long)) return name;
  std::string names;
  for (const std::string& each : ScenarioNames()) {
    names += (names.empty() ? "" : ", ") + each;
  }
  throw std::invalid_argument(
      "scenario '" + name + "' is unknown, must be a file or one of " + names);
}

// Reads a scenario from a dict with the keys of its YAML file. JSON is valid
// YAML, so that the reader of files is the only one.
Scenario FromDict(py::handle values, py::handle name) {
  if (!py::hasattr(values, "keys")) {
    throw std::invalid_argument("values is of type " + TypeName(values) +
                                ", must be a dict");
  }
  const std::string scenario_name = AsText(name, "name");
  std::string text;
  try {
    py::dict named;
    named.attr("update")(values);
    if (!named.contains("name")) named["name"] = scenario_name;
    const py::object as_list = py::cpp_function(
        [](py::handle value) { return value.attr("tolist")(); });
    text = AsText(py::module_::import("json").attr("dumps")(
                      named, py::arg("default") = as_list,
                      py::arg("ensure_ascii") = false),
                  "values");
  } catch (py::error_already_set& error) {
    throw std::invalid_argument(
        "the scenario must be made of dict, list, str, numbers and bool: " +
        py::cast<std::string>(py::str(error.value())));
  }
  const py::gil_scoped_release release;
  Scenario scenario = ParseScenario(text, "scenario", scenario_name);
  Validate(scenario);
  return scenario;
}

// Replaces a field if the scenario is still valid.
template <typename Value>
void Set(Value Scenario::*field, const Value& value, Scenario* scenario) {
  Scenario changed = *scenario;
  changed.*field = value;
  Validate(changed);
  *scenario = changed;
}

using ScenarioClass = py::class_<Scenario>;

void AddFields(ScenarioClass* scenario) {
  scenario->def_property_readonly(
      "name", [](const Scenario& self) { return self.name; },
      "The name of the scenario.");
  scenario->def_property(
      "duration", [](const Scenario& self) { return self.duration; },
      [](Scenario& self, py::handle value) {
        Set(&Scenario::duration, AsNumber(value, "duration"), &self);
      },
      "The simulated time, s.");
  scenario->def_property(
      "seed", [](const Scenario& self) { return self.seed; },
      [](Scenario& self, py::handle value) {
        constexpr int kMost = 2147483647;
        self.seed = AsInteger(value, "seed", 0, kMost);
      },
      "The seed of all random numbers, 0 to 2^31 - 1.");
  scenario->def_property(
      "steps", [](const Scenario& self) { return self.steps; },
      [](Scenario& self, py::handle value) {
        self.steps = AsFlag(value, "steps");
      },
      "Whether the robot may take steps.");
  scenario->def_property_readonly(
      "control_dt", [](const Scenario& self) { return self.control.dt; },
      "The control period, s.");
}

}  // namespace

void BindScenario(py::module_* module) {
  ScenarioClass scenario(
      *module, "Scenario",
      "One experiment: pushes, plant, sensors and settings of the controller. "
      "docs/scenarios.md lists the keys."
      "\n\n"
      ">>> scenario = poise.Scenario.from_dict(\n"
      "...     {'duration': 3, 'pushes': [{'force': [0, 60, 0]}]})\n"
      ">>> scenario.steps = True\n"
      ">>> scenario.add_push(force=[40, 0, 0], at=2.0, duration=0.1)\n"
      ">>> scenario.duration, scenario.num_pushes\n"
      "(3.0, 2)\n");
  scenario.def_static(
      "load",
      [](py::handle name_or_file) {
        const std::string name = AsText(name_or_file, "name");
        const py::gil_scoped_release release;
        return LoadScenario(FindScenario(name));
      },
      py::arg("name"),
      "Reads a scenario of Poise by its name ('strong_push'), or a YAML file.");
  scenario.def_static(
      "from_dict", FromDict, py::arg("values"), py::arg("name") = "scenario",
      "Makes a scenario from a dict with the keys of its YAML file: "
      "{'duration': 3, 'pushes': [{'force': [0, 60, 0]}]}. NumPy arrays are "
      "read as lists. name: used if the dict has no 'name'.");
  scenario.def_static("names", ScenarioNames,
                      "Returns the names of Poise's scenarios.");
  AddFields(&scenario);
  scenario.def(
      "add_push",
      [](Scenario& self, py::handle force, py::handle at, py::handle duration,
         py::handle link, py::handle point, py::handle moment,
         py::handle profile) {
        const Push push = MakePush(force, AsNumber(at, "at"), duration, link,
                                   point, moment, profile);
        Scenario changed = self;
        changed.pushes.push_back(push);
        {
          const py::gil_scoped_release release;
          Validate(changed);
        }
        self = changed;
      },
      py::arg("force"), py::arg("at") = 1.0, py::arg("duration") = 0.15,
      py::arg("link") = "", py::arg("point") = py::none(),
      py::arg("moment") = py::none(), py::arg("profile") = "box",
      "Adds a push.\n\n"
      "force (3,), N, and moment (3,), N m: the peak, world axes. at, "
      "duration: s. link: the torso by default. point (3,): in the link, m; "
      "the center of mass by default. profile: 'box', 'half_sine' or "
      "'impulse'.");
  scenario.def(
      "clear_pushes", [](Scenario& self) { self.pushes.clear(); },
      "Removes all pushes.");
  scenario.def("__repr__", [](const Scenario& self) {
    return "<poise.Scenario " + Repr(self.name) + ", " +
           PrintNumber(self.duration) + " s, " +
           Count(static_cast<std::ptrdiff_t>(self.pushes.size()), "push",
                 "pushes") +
           ">";
  });
  scenario.def_property_readonly(
      "num_pushes", [](const Scenario& self) { return self.pushes.size(); },
      "The number of pushes.");
}

}  // namespace poise
