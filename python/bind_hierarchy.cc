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
#include "poise/python/python_hierarchy.h"
#include "poise/python/text.h"

namespace poise {
namespace {

// Reads the rows of a matrix argument with n columns; None has no rows.
RowMajorMatrix Rows(py::handle value, const char* name, int n) {
  if (value.is_none()) return RowMajorMatrix(0, n);
  return MatrixOf(AsArray(value, name, {kAny, n}));
}

// Reads one number for each row; None gives `otherwise`.
Eigen::VectorXd Numbers(py::handle value, const char* name, py::ssize_t rows,
                        double otherwise) {
  if (value.is_none()) return Eigen::VectorXd::Constant(rows, otherwise);
  return VectorOf(AsVector(value, name, rows));
}

std::vector<std::string> Names(py::handle value, const char* name,
                               py::ssize_t rows) {
  if (value.is_none()) return std::vector<std::string>(rows);
  std::vector<std::string> names = AsTexts(value, name);
  if (static_cast<py::ssize_t>(names.size()) != rows) {
    throw std::invalid_argument(
        std::string(name) + " has " + std::to_string(names.size()) +
        " names, must have " + std::to_string(rows) + ", one a row");
  }
  return names;
}

void AddLevel(PythonHierarchy* self, py::handle B, py::handle b, py::handle C,
              py::handle lower, py::handle upper, py::handle weight,
              py::handle name, py::handle equality_names,
              py::handle inequality_names) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  auto level = std::make_shared<PythonLevel>();
  level->B = Rows(B, "B", self->num_variables);
  level->b = Numbers(b, "b", level->B.rows(), 0);
  level->weight = Numbers(weight, "weight", level->B.rows(), 1);
  level->C = Rows(C, "C", self->num_variables);
  level->lower = Numbers(lower, "lower", level->C.rows(), -kInfinity);
  level->upper = Numbers(upper, "upper", level->C.rows(), kInfinity);
  if (!name.is_none()) level->name = AsText(name, "name");
  level->equality_names =
      Names(equality_names, "equality_names", level->B.rows());
  level->inequality_names =
      Names(inequality_names, "inequality_names", level->C.rows());
  self->levels.push_back(std::move(level));
}

using LevelClass = py::class_<PythonLevel, std::shared_ptr<PythonLevel>>;

// Adds a property that copies a member.
template <typename Member>
void AddMember(const char* name, Member PythonLevel::*member, const char* doc,
               LevelClass* level) {
  level->def_property_readonly(
      name, [member](const PythonLevel& self) { return ToArray(self.*member); },
      doc);
}

void BindLevel(py::module_* module) {
  LevelClass level(
      *module, "Level",
      "The rows of one level of a Hierarchy, which never change. Arrays are "
      "copies.");
  AddMember("B", &PythonLevel::B, "(m, n) Rows B y + b = 0.", &level);
  AddMember("b", &PythonLevel::b, "(m,) The constants of the rows of B.",
            &level);
  AddMember("weight", &PythonLevel::weight, "(m,) The weight of each row of B.",
            &level);
  AddMember("C", &PythonLevel::C, "(k, n) Rows lower <= C y <= upper.", &level);
  AddMember("lower", &PythonLevel::lower, "(k,) May be -inf.", &level);
  AddMember("upper", &PythonLevel::upper, "(k,) May be inf.", &level);
  level.def_readonly("name", &PythonLevel::name,
                     "The name of the level, or ''.");
  level.def_readonly("equality_names", &PythonLevel::equality_names,
                     "The names of the rows of B.");
  level.def_readonly("inequality_names", &PythonLevel::inequality_names,
                     "The names of the rows of C.");
  level.def("__repr__", [](const PythonLevel& self) {
    return "<poise.Level " + Repr(self.name) + ", " +
           Count(self.B.rows(), "equality", "equalities") + ", " +
           Count(self.C.rows(), "inequality", "inequalities") + ">";
  });
}

}  // namespace

void BindHierarchy(py::module_* module) {
  BindLevel(module);
  py::class_<PythonHierarchy, std::shared_ptr<PythonHierarchy>> hierarchy(
      *module, "Hierarchy",
      "A hierarchical quadratic program in y (n,), the highest level first. A "
      "level minimises (sum of weight (B y + b)^2 + |slack|^2) / 2 of its rows "
      "B y + b = 0 and lower <= C y <= upper, and no level changes the cost of "
      "a level above."
      "\n\n"
      ">>> hierarchy = poise.Hierarchy(2)\n"
      ">>> hierarchy.add_level(C=[[1, 0]], upper=[1])  # y[0] <= 1\n"
      ">>> hierarchy.add_level(B=np.eye(2), b=[-3, -2])  # y = (3, 2)\n"
      ">>> poise.Solver(2).solve(hierarchy).y\n"
      "array([1., 2.])\n");
  hierarchy.def(py::init([](py::handle n) {
                  constexpr int kMost = 100000;
                  auto made = std::make_shared<PythonHierarchy>();
                  made->num_variables = AsInteger(n, "n", 0, kMost);
                  return made;
                }),
                py::arg("n"),
                "Makes a hierarchy without levels in n variables.");
  hierarchy.def_readonly("n", &PythonHierarchy::num_variables,
                         "The number of variables.");
  hierarchy.def_property_readonly(
      "levels", [](const PythonHierarchy& self) { return self.levels; },
      "The levels, highest first. The list is a copy.");
  hierarchy.def("__repr__", [](const PythonHierarchy& self) {
    return "<poise.Hierarchy, " + Count(self.num_variables, "variable") + ", " +
           Count(static_cast<std::ptrdiff_t>(self.levels.size()), "level") +
           ">";
  });
  hierarchy.def(
      "add_level", AddLevel, py::kw_only(), py::arg("B") = py::none(),
      py::arg("b") = py::none(), py::arg("C") = py::none(),
      py::arg("lower") = py::none(), py::arg("upper") = py::none(),
      py::arg("weight") = py::none(), py::arg("name") = py::none(),
      py::arg("equality_names") = py::none(),
      py::arg("inequality_names") = py::none(),
      "Adds a level below all others. Arguments are copied.\n\n"
      "B (m, n), b (m,), weight (m,): equalities, 0 and 1 by default. C (k, "
      "n), lower (k,), upper (k,): inequalities, unbounded by default. name "
      "and the names of the rows are used by Solution.explain().");
}

}  // namespace poise
