// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/recursion.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/as_object.h"
#include "poise/python/bind.h"
#include "poise/python/exclusive.h"
#include "poise/python/interrupt.h"
#include "poise/python/make_push.h"
#include "poise/python/python_controller.h"
#include "poise/python/python_robot.h"
#include "poise/python/python_task.h"
#include "poise/python/text.h"
#include "poise/robot/finding.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/judge.h"
#include "poise/sim/observation.h"

namespace poise {
namespace {

// A closed loop and its judge.
struct PythonSimulation {
  PythonSimulation(const Robot& robot, const Scenario& scenario,
                   const std::function<void(Stack*)>& add_tasks)
      : loop(robot, scenario, add_tasks),
        judge(StandingHeight(robot), scenario.steps) {}

  ClosedLoop loop;
  Judge judge;
  long ticks = 0;
  std::shared_ptr<InUse> in_use = std::make_shared<InUse>();

  const ClosedLoop& get() const {
    in_use->Check("this Simulation");
    return loop;
  }
};

using Owner = std::shared_ptr<PythonSimulation>;
using SimulationClass = py::class_<PythonSimulation, Owner>;

Owner MakeSimulation(py::handle robot_argument, py::handle scenario,
                     py::handle tasks) {
  const auto& robot = AsObject<PythonRobot>(robot_argument, "robot");
  const auto add_tasks = TasksToAdd(tasks);
  Scenario with_tasks = AsObject<Scenario>(scenario, "scenario");
  UseTasksOf(robot.profile, &with_tasks);
  const py::gil_scoped_release release;
  return std::make_shared<PythonSimulation>(*robot.robot, with_tasks,
                                            add_tasks);
}

// Ticks n times, or until Ctrl-C.
void Step(PythonSimulation* self, py::handle n) {
  const int ticks = AsInteger(n, "n", 0, std::numeric_limits<int>::max());
  const Exclusive exclusive(self->in_use.get(), "this Simulation");
  ForgetInterrupt();
  {
    const py::gil_scoped_release release;
    InterruptCheck check;
    for (int i = 0; i < ticks; ++i) {
      self->loop.Tick();
      self->judge.Look(self->loop.observation());
      ++self->ticks;
      if (check.Look(i + 1)) break;
    }
  }
  RaiseInterrupt();
}

void PushNow(PythonSimulation* self, py::handle force, py::handle duration,
             py::handle at, py::handle link, py::handle point,
             py::handle moment, py::handle profile) {
  const double now = self->get().time();
  const double start = at.is_none() ? now : AsNumber(at, "at");
  const Push push =
      MakePush(force, start, duration, link, point, moment, profile);
  const Exclusive exclusive(self->in_use.get(), "this Simulation");
  const py::gil_scoped_release release;
  self->loop.AddPush(push);
}

// Adds a property of the plant's true state.
template <typename Get>
void Add(const char* name, Get get, const char* doc,
         SimulationClass* simulation) {
  simulation->def_property_readonly(
      name, [get](const PythonSimulation& self) { return get(self.get()); },
      doc);
}

// Adds an array of the last tick, or of NaN before the first one.
template <typename Get>
void AddOfTick(const char* name, Get get, const char* doc,
               SimulationClass* simulation) {
  simulation->def_property_readonly(
      name,
      [get](const PythonSimulation& self) {
        auto values = get(self.get()).eval();
        if (self.ticks == 0) {
          values.setConstant(std::numeric_limits<double>::quiet_NaN());
        }
        return ToArray(values);
      },
      doc);
}

// Returns the true center of mass at the start of the last tick.
Eigen::Vector3d CenterOfMassOf(const PythonSimulation& self) {
  const ClosedLoop& loop = self.get();
  if (self.ticks > 0) return loop.observation().com;
  const Tree& tree = loop.robot().model.tree;
  Recursion scratch(tree);
  CenterOfMass com(tree);
  ComputeCenterOfMass(tree, loop.plant().Sense().q,
                      Eigen::VectorXd::Zero(tree.nv()), &scratch, &com);
  return com.p_WG;
}

void AddState(SimulationClass* simulation) {
  Add(
      "time", [](const ClosedLoop& loop) { return loop.time(); },
      "The simulated time, s.", simulation);
  Add(
      "q",
      [](const ClosedLoop& loop) { return ToArray(loop.plant().Sense().q); },
      "(nq,) The true configuration. A copy.", simulation);
  Add(
      "v",
      [](const ClosedLoop& loop) { return ToArray(loop.plant().Sense().v); },
      "(nv,) The true velocity. A copy.", simulation);
  AddOfTick(
      "tau", [](const ClosedLoop& loop) { return loop.record().tau; },
      "(joints,) The torques of the last command, N m or N; NaN before the "
      "first tick. A copy.",
      simulation);
  simulation->def_property_readonly(
      "com",
      [](const PythonSimulation& self) {
        return ToArray(CenterOfMassOf(self));
      },
      "(3,) The true center of mass at the start of the last tick, or now "
      "before the first tick, m.");
  AddOfTick(
      "com_reference",
      [](const ClosedLoop& loop) { return loop.observation().com_ref; },
      "(3,) The desired center of mass in the last tick, m; NaN before the "
      "first tick.",
      simulation);
  AddOfTick(
      "cop", [](const ClosedLoop& loop) { return loop.observation().cop; },
      "(2,) The center of pressure in the last tick, in the mid-feet frame, "
      "m; NaN without a load, and before the first tick.",
      simulation);
  Add(
      "status",
      [](const ClosedLoop& loop) {
        return StatusOf(loop.controller().report());
      },
      "The status of the last tick, see Command.status; '' before the first "
      "tick.",
      simulation);
}

}  // namespace

void BindSimulation(py::module_* module) {
  SimulationClass simulation(
      *module, "Simulation",
      "A robot, its plant and its controller, tick by tick. Two simulations of "
      "one robot and scenario agree to the bit."
      "\n\n"
      ">>> simulation = poise.Simulation(\n"
      "...     poise.Robot.load(), poise.Scenario.load('stand'))\n"
      ">>> simulation.push(force=[0, 60, 0], duration=0.1)\n"
      ">>> simulation.step(10)\n"
      ">>> simulation.status, simulation.ticks, simulation.has_fallen\n"
      "('ok', 10, False)\n");
  simulation.def(py::init(&MakeSimulation), py::arg("robot"),
                 py::arg("scenario"), py::arg("tasks") = py::tuple(),
                 "Makes a simulation at time 0. The scenario is copied and "
                 "fitted to the robot. tasks: Tasks of your own.");
  simulation.def("step", Step, py::arg("n") = 1,
                 "Runs n control ticks, also beyond the scenario's duration. "
                 "Other threads run meanwhile, but must not use this "
                 "simulation.");
  simulation.def(
      "push", PushNow, py::arg("force"), py::arg("duration") = 0.15,
      py::arg("at") = py::none(), py::arg("link") = "",
      py::arg("point") = py::none(), py::arg("moment") = py::none(),
      py::arg("profile") = "box",
      "Adds a push that starts now, or at a time in s. The other arguments are "
      "those of Scenario.add_push().");
  simulation.def("__repr__", [](const PythonSimulation& self) {
    if (self.in_use->is_set()) return std::string("<poise.Simulation, in use>");
    return "<poise.Simulation of " + Repr(self.loop.robot().model.name) +
           ", time " + PrintNumber(self.loop.time()) + " s>";
  });
  AddState(&simulation);
  simulation.def_property_readonly(
      "ticks",
      [](const PythonSimulation& self) {
        (void)self.get();
        return self.ticks;
      },
      "The number of ticks.");
  simulation.def_property_readonly(
      "has_fallen",
      [](const PythonSimulation& self) {
        (void)self.get();
        return self.judge.has_fallen();
      },
      "Whether the robot has broken a rule of recovery: the center of mass too "
      "low, the base or a foot too tilted, or a foot slid too far.");
  simulation.def_property_readonly(
      "controller",
      [](const Owner& self) {
        return std::make_shared<PythonController>(
            std::shared_ptr<Controller>(self, &self->loop.controller()),
            self->in_use);
      },
      "The Controller in the loop. Change its stack between two ticks.");
}

}  // namespace poise
