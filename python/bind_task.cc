// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/interrupt.h"
#include "poise/python/python_task.h"
#include "poise/python/text.h"
#include "poise/robot/control/task.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

// A copy of TaskInput, so that Python may keep it.
struct PythonTaskInput {
  State state;
  std::shared_ptr<Tick> tick;
  std::vector<bool> in_contact;
  Eigen::Vector3d com_reference;
};

std::vector<RowDescription> Describe(const std::vector<std::string>& names,
                                     RowKind kind) {
  std::vector<RowDescription> rows;
  for (const std::string& name : names) rows.push_back({name, "", name, kind});
  return rows;
}

// Calls rows() of a Python object. Copies its input and its answer, and waits
// for Python's global lock.
class TaskOfPython final : public Task {
 public:
  explicit TaskOfPython(py::object task, PythonTaskBase* base)
      : Task(base->name, Describe(base->equalities, RowKind::kTarget),
             Describe(base->inequalities, RowKind::kLimit)),
        task_(std::move(task)),
        base_(base) {}
  ~TaskOfPython() override {
    const py::gil_scoped_acquire acquire;
    task_ = py::object();
  }

  // An exception makes the rows NaN. The solver then refuses the problem, and
  // the tick ends in the fail-safe command with the reason "no_answer".
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const py::gil_scoped_acquire acquire;
    try {
      base_->error.clear();
      Read(task_.attr("rows")(MakeInput(input)), equalities, inequalities);
      return;
    } catch (py::error_already_set& error) {
      base_->error = error.what();
      // Ctrl-C and sys.exit() must end the program, not this tick alone.
      if (!error.matches(PyExc_Exception)) RememberInterrupt(error);
    } catch (const std::exception& error) {
      base_->error = error.what();
    }
    equalities->b.setConstant(kNaN);
    inequalities->upper.setConstant(kNaN);
  }

 private:
  static PythonTaskInput MakeInput(const TaskInput& input) {
    PythonTaskInput copy{input.state,
                         std::make_shared<Tick>(input.tick),
                         {},
                         input.reference.p_WG};
    for (const ContactTick& contact : input.contacts) {
      copy.in_contact.push_back(contact.in_contact);
    }
    return copy;
  }

  // Throws if declared rows are not given: zeros in their place would constrain
  // nothing, and no message would say so.
  void CheckKeys(const py::dict& given) const {
    const auto check = [&](const char* key, bool is_given,
                           const std::vector<std::string>& names) {
      if (names.empty() || is_given) return;
      throw std::invalid_argument(
          "task '" + base_->name + "': rows() lacks " + key +
          ", must have the " + std::to_string(names.size()) +
          (names.size() == 1 ? " row " : " rows ") +
          py::cast<std::string>(py::str(py::cast(names))));
    };
    check("'B'", given.contains("B"), base_->equalities);
    check("'C'", given.contains("C"), base_->inequalities);
    check("'lower' and 'upper', one of them",
          given.contains("lower") || given.contains("upper"),
          base_->inequalities);
  }

  // Reads (B, b), or a dict with the keys B, b, C, lower and upper.
  void Read(const py::object& rows, EqualityBlock* equalities,
            InequalityBlock* inequalities) const {
    py::dict given;
    if (py::isinstance<py::dict>(rows)) {
      given = rows;
    } else if (py::isinstance<py::tuple>(rows) && py::len(rows) == 2) {
      given["B"] = rows[py::int_(0)];
      given["b"] = rows[py::int_(1)];
    } else {
      throw std::invalid_argument("rows() returned " + TypeName(rows) +
                                  ", must be (B, b) or a dict");
    }
    CheckKeys(given);
    for (const auto& [key, value] : given) {
      const std::string name = AsText(key, "a key of rows()");
      const auto matrix = [&value = value, &name](auto* to) {
        *to = MatrixOf(AsArray(value, name.c_str(), {to->rows(), to->cols()}));
      };
      const auto vector = [&value = value, &name](auto* to) {
        *to = VectorOf(AsVector(value, name.c_str(), to->size()));
      };
      if (name == "B") {
        matrix(&equalities->B);
      } else if (name == "b") {
        vector(&equalities->b);
      } else if (name == "C") {
        matrix(&inequalities->C);
      } else if (name == "lower") {
        vector(&inequalities->lower);
      } else if (name == "upper") {
        vector(&inequalities->upper);
      } else {
        throw std::invalid_argument("rows() has the key '" + name +
                                    "', must be B, b, C, lower or upper");
      }
    }
  }

  py::object task_;
  PythonTaskBase* base_;  // Inside task_.
};

std::unique_ptr<PythonTaskBase> MakeTask(py::handle name, py::handle equalities,
                                         py::handle inequalities,
                                         py::handle level, py::handle weight) {
  PythonTaskBase task;
  task.name = AsText(name, "name");
  task.equalities = AsTexts(equalities, "equalities");
  task.inequalities = AsTexts(inequalities, "inequalities");
  task.settings.level = AsInteger(level, "level", 1, Stack::kMaxLevel);
  task.settings.weight = AsNumber(weight, "weight");
  if (task.equalities.empty() && task.inequalities.empty()) {
    throw std::invalid_argument(
        "task '" + task.name +
        "' has no rows: equalities or inequalities must name them");
  }
  return std::make_unique<PythonTaskBase>(std::move(task));
}

void BindTaskInput(py::module_* module) {
  py::class_<PythonTaskInput> input(*module, "TaskInput",
                                    "The input of Task.rows(), a copy.");
  input.def_property_readonly(
      "q", [](const PythonTaskInput& self) { return ToArray(self.state.q); },
      "(nq,) See Tree.");
  input.def_property_readonly(
      "v", [](const PythonTaskInput& self) { return ToArray(self.state.v); },
      "(nv,) See Tree.");
  input.def_property_readonly(
      "time", [](const PythonTaskInput& self) { return self.state.time; },
      "The time stamp of the state, s.");
  input.def_readonly("tick", &PythonTaskInput::tick,
                     "The Tick. frames[i] is the frame of Robot.feet[i]: the "
                     "left foot, then the right one; `frames` of the "
                     "Controller follow.");
  input.def_readonly("in_contact", &PythonTaskInput::in_contact,
                     "Whether each foot is in contact.");
  input.def_property_readonly(
      "com_reference",
      [](const PythonTaskInput& self) { return ToArray(self.com_reference); },
      "(3,) The desired center of mass, m.");
  input.def("__repr__", [](const PythonTaskInput& self) {
    return "<poise.TaskInput, time " + PrintNumber(self.state.time) + " s>";
  });
}

}  // namespace

std::function<void(Stack*)> TasksToAdd(py::handle tasks) {
  if (!py::isinstance<py::list>(tasks) && !py::isinstance<py::tuple>(tasks)) {
    throw std::invalid_argument("tasks is of type " + TypeName(tasks) +
                                ", must be a list of Task");
  }
  for (const py::handle task : tasks) {
    if (py::isinstance<PythonTaskBase>(task)) continue;
    throw std::invalid_argument("tasks has an entry of type " + TypeName(task) +
                                ", must be of Task");
  }
  if (py::len(tasks) == 0) return {};
  // The function is called before the caller returns, so it needs no copy.
  return [tasks](Stack* stack) {
    const py::gil_scoped_acquire acquire;
    for (const py::handle task : tasks) {
      auto* base = task.cast<PythonTaskBase*>();
      stack->Add(std::make_unique<TaskOfPython>(
                     py::reinterpret_borrow<py::object>(task), base),
                 base->settings);
    }
  };
}

void BindTask(py::module_* module) {
  BindTaskInput(module);
  py::class_<PythonTaskBase> task(
      *module, "Task",
      "A task written in Python: derive a class with a method rows(input). "
      "Slow: rows() runs in each tick, with copies of its input. A controller "
      "keeps its tasks alive. Do not store the controller in one of its tasks: "
      "Python could then free none of them."
      "\n\n"
      ">>> class BaseStill(poise.Task):\n"
      "...     def rows(self, input):\n"
      "...         B = np.eye(3, len(input.v) + 12)  # v begins with w_WB.\n"
      "...         return B, 10 * input.v[:3]\n"
      ">>> task = BaseStill('base_still', ['x', 'y', 'z'], level=5)\n"
      ">>> controller = poise.Controller(poise.Robot.load(), tasks=[task])\n"
      ">>> controller.stack['base_still'].level\n"
      "5\n");
  task.def(py::init(&MakeTask), py::arg("name"),
           py::arg("equalities") = py::tuple(),
           py::arg("inequalities") = py::tuple(), py::arg("level") = 4,
           py::arg("weight") = 1.0,
           "equalities, inequalities: the names of the rows, at least one "
           "in all, which never change. level: 1 is the highest.");
  task.def(
      "rows",
      [](const PythonTaskBase& self, py::handle) -> py::object {
        throw std::invalid_argument("task '" + self.name +
                                    "' has no method rows(input)");
      },
      py::arg("input"),
      "Returns the rows of a tick in y = [vdot (nv); wrench (6) of each foot]: "
      "(B, b) for B y + b = 0, or a dict with B, b, C, lower, upper for lower "
      "<= C y <= upper too. B, and C with lower or upper, must be given if the "
      "task has such rows; b is 0 by default. input.tick.frames[i] is the "
      "frame of Robot.feet[i].\n\n"
      "If rows() raises, the tick ends in the fail-safe command with the "
      "reason 'no_answer', and `error` has the message. KeyboardInterrupt and "
      "SystemExit end update(), step() or run() as well.");
  task.def_readonly("name", &PythonTaskBase::name,
                    "The name of the task in the stack.");
  task.def_readonly("error", &PythonTaskBase::error,
                    "The exception of the last rows(), or ''.");
  task.def("__repr__", [](const PythonTaskBase& self) {
    return "<poise.Task " + Repr(self.name) + ">";
  });
}

}  // namespace poise
