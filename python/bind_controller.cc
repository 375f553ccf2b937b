// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/as_object.h"
#include "poise/python/bind.h"
#include "poise/python/interrupt.h"
#include "poise/python/python_controller.h"
#include "poise/python/python_task.h"
#include "poise/python/text.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

// Makes a controller with the tasks of the robot's profile.
std::shared_ptr<PythonController> MakeController(
    py::handle robot_argument, py::handle dt, py::handle friction,
    py::handle max_iterations, py::handle frames, py::handle own_tasks,
    py::handle max_modelled_seconds) {
  const auto& robot = AsObject<PythonRobot>(robot_argument, "robot");
  ControllerOptions options;
  options.add_tasks = TasksToAdd(own_tasks);
  options.dt = AsNumber(dt, "dt");
  options.friction = AsNumber(friction, "friction");
  options.max_iterations = AsInteger(max_iterations, "max_iterations", 1,
                                     std::numeric_limits<int>::max());
  options.max_modelled_seconds =
      AsNumber(max_modelled_seconds, "max_modelled_seconds");
  options.frames = AsTexts(frames, "frames");
  const YAML::Node tasks = robot.profile.tasks;
  if (tasks.IsDefined()) {
    for (const std::string& link : FindTaskLinks(tasks, *robot.robot)) {
      options.frames.push_back(link);
    }
  }
  const std::shared_ptr<const Robot> of = robot.robot;
  const std::string profile = robot.profile_file;
  std::shared_ptr<Controller> controller;
  {
    const py::gil_scoped_release release;
    controller = std::make_shared<Controller>(*of, options);
  }
  if (tasks.IsDefined()) ApplyTasks(tasks, profile, &controller->stack());
  return std::make_shared<PythonController>(std::move(controller),
                                            std::make_shared<InUse>());
}

std::unique_ptr<State> MakeState(py::handle q, py::handle v, py::handle time) {
  return std::make_unique<State>(State{AsNumber(time, "time"),
                                       VectorOf(AsArray(q, "q", {kAny})),
                                       VectorOf(AsArray(v, "v", {kAny}))});
}

// Throws if the sizes of a state are not those of the robot.
void CheckState(const Controller& controller, const State& state) {
  const Tree& tree = controller.robot().model.tree;
  const std::pair<const char*, std::pair<py::ssize_t, int>> sizes[] = {
      {"q", {state.q.size(), tree.nq()}}, {"v", {state.v.size(), tree.nv()}}};
  for (const auto& [name, size] : sizes) {
    if (size.first == size.second) continue;
    throw std::invalid_argument("state." + std::string(name) + " has shape " +
                                ShapeText({size.first}) + ", must have shape " +
                                ShapeText({size.second}));
  }
}

std::unique_ptr<Command> Update(const PythonController& self,
                                py::handle argument) {
  const State& state = AsObject<State>(argument, "state");
  Controller& controller = self.get();
  CheckState(controller, state);
  auto command = std::make_unique<Command>();
  command->tau.setZero(controller.robot().model.tree.num_joints());
  const State copy = state;  // Another thread may change the state.
  {
    const Exclusive exclusive(self.in_use(), "this Controller");
    ForgetInterrupt();
    const py::gil_scoped_release release;
    controller.Update(copy, command.get());
  }
  RaiseInterrupt();
  return command;
}

void Start(const PythonController& self, py::handle argument) {
  const State& state = AsObject<State>(argument, "state");
  Controller& controller = self.get();
  CheckState(controller, state);
  const State copy = state;  // Another thread may change the state.
  const Exclusive exclusive(self.in_use(), "this Controller");
  const py::gil_scoped_release release;
  controller.Start(copy);
}

void BindStateAndCommand(py::module_* module) {
  py::class_<State> state(*module, "State", "The state of a robot.");
  state.def(py::init(&MakeState), py::arg("q"), py::arg("v"),
            py::arg("time") = 0.0,
            "Copies q (nq,) and v (nv,), see Tree; time in s.");
  state.def_property(
      "time", [](const State& self) { return self.time; },
      [](State& self, py::handle time) { self.time = AsNumber(time, "time"); },
      "The time of the measurement, s.");
  state.def_property(
      "q", [](const State& self) { return ToArray(self.q); },
      [](State& self, py::handle q) {
        self.q = VectorOf(AsVector(q, "q", self.q.size()));
      },
      "(nq,) A copy.");
  state.def_property(
      "v", [](const State& self) { return ToArray(self.v); },
      [](State& self, py::handle v) {
        self.v = VectorOf(AsVector(v, "v", self.v.size()));
      },
      "(nv,) A copy.");
  state.def("__repr__", [](const State& self) {
    return "<poise.State, " + std::to_string(self.q.size()) + " q, " +
           std::to_string(self.v.size()) + " v, time " +
           PrintNumber(self.time) + " s>";
  });

  py::class_<Command> command(*module, "Command",
                              "The output of Controller.update().");
  command.def_property_readonly(
      "tau",
      [](py::object self) { return View(self.cast<Command&>().tau, self); },
      "(joints,) Torques within the effort limits, N m or N. Read-only.");
  command.def_property_readonly(
      "status", [](const Command& self) { return NameOf(self.status); },
      "'ok', 'limit_relaxed', 'truncated' or 'fail_safe'.");
  command.def("__repr__", [](const Command& self) {
    return "<poise.Command, " + NameOf(self.status) + ", " +
           Count(self.tau.size(), "torque") + ">";
  });
}

// Adds a vector of the reference.
template <typename Member>
void AddReference(const char* name, Member Reference::*member, const char* doc,
                  ControllerClass* controller) {
  controller->def_property(
      name,
      [member](const PythonController& self) {
        return ToArray(self.get().reference().*member);
      },
      [member, name](const PythonController& self, py::handle value) {
        auto& to = self.get().reference().*member;
        to = VectorOf(AsVector(value, name, to.size()));
      },
      doc);
}

}  // namespace

void BindController(py::module_* module) {
  BindStateAndCommand(module);
  BindStack(module);
  BindTickReport(module);
  ControllerClass controller(
      *module, "Controller",
      "Computes joint torques from the state of a robot, by momentum control "
      "with hierarchical inverse dynamics. Call update() once each dt."
      "\n\n"
      ">>> robot = poise.Robot.load()\n"
      ">>> state = poise.State(robot.posture, np.zeros(robot.tree.nv))\n"
      ">>> controller = poise.Controller(robot)\n"
      ">>> controller.start(state)\n"
      ">>> state.time = 1e-3\n"
      ">>> command = controller.update(state)\n"
      ">>> command.status, command.tau.shape\n"
      "('ok', (50,))\n");
  controller.def(
      py::init(&MakeController), py::arg("robot"), py::arg("dt") = 1e-3,
      py::arg("friction") = 0.5, py::arg("max_iterations") = 500,
      py::arg("frames") = py::tuple(), py::arg("tasks") = py::tuple(),
      py::arg("max_modelled_seconds") = 0,
      "Makes a controller with the tasks of the robot's profile. dt: s. "
      "friction: the coefficient that the controller assumes. frames: links "
      "with a task 'frame.NAME'. tasks: Tasks of your own. "
      "max_modelled_seconds: limit of the solver's predicted time in a tick, "
      "s; 0: no limit.");
  controller.def(
      "start", Start, py::arg("state"),
      "Sets the reference to standing still with the feet where they are.");
  controller.def(
      "update", Update, py::arg("state"),
      "Computes the Command of one tick. For any state, also with NaN, the "
      "torques are finite and within the limits. Copies the state. Other "
      "threads run meanwhile, but must not use this controller.");
  AddReference("com_reference", &Reference::p_WG,
               "(3,) The desired center of mass, world, m.", &controller);
  AddReference("com_velocity_reference", &Reference::v_WG,
               "(3,) The desired velocity of the center of mass, m/s.",
               &controller);
  AddReference("com_acceleration_reference", &Reference::a_WG,
               "(3,) The desired acceleration of the center of mass, m/s2.",
               &controller);
  AddReference("posture_reference", &Reference::posture,
               "(joints,) The desired joints, rad or m.", &controller);
  controller.def("__repr__", [](const PythonController& self) {
    if (self.in_use()->is_set())
      return std::string("<poise.Controller, in use>");
    const Controller& of = self.get();
    return "<poise.Controller of " + Repr(of.robot().model.name) + ", " +
           Count(of.stack().num_tasks(), "task") + ">";
  });
  AddStack(&controller);
  AddReport(&controller);
}

}  // namespace poise
