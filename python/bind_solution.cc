// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "poise/hqp/solution.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/python_solution.h"
#include "poise/python/text.h"
#include "poise/robot/control/conflict.h"
#include "poise/robot/finding.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

// The answer for one level, as a view of its solution.
struct PythonLevelSolution {
  std::shared_ptr<PythonSolution> solved;
  int level;

  const LevelSolution& answer() const { return solved->solution.levels[level]; }
  int equalities(int of) const { return solved->num_equalities(of); }
  int inequalities(int of) const { return solved->num_inequalities(of); }
};

const char* SideName(Side side) {
  if (side == Side::kNone) return "";
  return side == Side::kUpper ? "upper" : "lower";
}

// Returns the multipliers on the rows of each level above.
py::list Multipliers(const PythonLevelSolution& self) {
  py::list multipliers;
  for (int j = 0; j < self.level; ++j) {
    const LevelMultipliers& of = self.answer().multipliers[j];
    multipliers.append(
        py::make_tuple(ToArray(of.equality.head(self.equalities(j))),
                       ToArray(of.inequality.head(self.inequalities(j)))));
  }
  return multipliers;
}

py::list ActiveRows(const PythonSolution& self) {
  py::list rows;
  for (int level = 0; level < self.num_levels(); ++level) {
    for (int i = 0; i < self.num_inequalities(level); ++i) {
      const Side side = self.solution.levels[level].active[i];
      if (side == Side::kNone) continue;
      rows.append(py::make_tuple(level, i, SideName(side)));
    }
  }
  return rows;
}

py::list Conflict(const PythonSolution& self, py::handle level) {
  const int last = self.num_levels() - 1;
  const int index = AsInteger(level, "level", 0, std::max(last, 0));
  std::vector<std::string> rows;
  if (last >= 0 && self.solution.status != Status::kNotFinite &&
      self.solution.status != Status::kBadInput) {
    const py::gil_scoped_release release;
    for (const HierarchyRow& row :
         FindConflict(MakeHierarchy(self.source), index)) {
      rows.push_back(NameRow(self.source, row.level, row.row, row.equality));
    }
  }
  return py::cast(rows);
}

std::vector<double> Gaps(const PythonSolution& self) {
  std::vector<double> gaps;
  for (int level = 0; level < self.num_levels(); ++level) {
    gaps.push_back(self.solution.levels[level].gap);
  }
  return gaps;
}

void BindCertificate(py::module_* module) {
  py::class_<Certificate> certificate(
      *module, "Certificate",
      "The optimality error of a solution, computed from its answer alone. "
      "Each number is relative; rounding gives about 1e-15.");
  certificate.def_readonly("stationarity", &Certificate::stationarity,
                           "The error of the gradients of the Lagrangians.");
  certificate.def_readonly("feasibility", &Certificate::feasibility,
                           "The error of the residuals and slacks.");
  certificate.def_readonly("complementarity", &Certificate::complementarity,
                           "The error of the multipliers' signs.");
  certificate.def_readonly("priority", &Certificate::priority,
                           "The error of the costs.");
  certificate.def_property_readonly(
      "worst", [](const Certificate& self) { return self.worst(); },
      "The largest of the four; at most 1e-9 if the status is 'optimal'.");
  certificate.def("__repr__", [](const Certificate& self) {
    return "<poise.Certificate, worst " + PrintNumber(self.worst()) + ">";
  });
}

void BindLevelSolution(py::module_* module) {
  py::class_<PythonLevelSolution> level(*module, "LevelSolution",
                                        "The answer for one level.");
  level.def_property_readonly(
      "cost",
      [](const PythonLevelSolution& self) { return self.answer().cost; },
      "(sum of weight (B y + b)^2 + |slack|^2) / 2.");
  level.def_property_readonly(
      "gap", [](const PythonLevelSolution& self) { return self.answer().gap; },
      "How far the cost may be above its optimum, given the levels above.");
  level.def_property_readonly(
      "residual",
      [](const PythonLevelSolution& self) {
        return ToArray(
            self.answer().equality_residual.head(self.equalities(self.level)));
      },
      "(m,) B y + b. A copy.");
  level.def_property_readonly(
      "slack",
      [](const PythonLevelSolution& self) {
        return ToArray(self.answer().slack.head(self.inequalities(self.level)));
      },
      "(k,) The violation of each inequality, 0 or more. A copy.");
  level.def_property_readonly(
      "active",
      [](const PythonLevelSolution& self) {
        std::vector<int> sides;
        for (int i = 0; i < self.inequalities(self.level); ++i) {
          sides.push_back(static_cast<int>(self.answer().active[i]));
        }
        return sides;
      },
      "For each inequality: 1 at upper, -1 at lower, 0 if inactive.");
  level.def_property_readonly(
      "nullity",
      [](const PythonLevelSolution& self) { return self.answer().nullity; },
      "Variables minus the rank of this level's and the higher levels' "
      "equalities and violated rows.");
  level.def_property_readonly(
      "multipliers", Multipliers,
      "For each level above: a pair of the multipliers (m,) on its equalities "
      "and (k,) on its inequalities, positive at upper. Copies.");
  level.def("__repr__", [](const PythonLevelSolution& self) {
    return "<poise.LevelSolution " + std::to_string(self.level) + ", cost " +
           PrintNumber(self.answer().cost) + ">";
  });
}

}  // namespace

void BindSolution(py::module_* module) {
  BindCertificate(module);
  BindLevelSolution(module);
  py::class_<PythonSolution, std::shared_ptr<PythonSolution>> solution(
      *module, "Solution", "The answer of Solver.solve().");
  solution.def_property_readonly(
      "status",
      [](const PythonSolution& self) { return Name(self.solution.status); },
      "'optimal'; 'iteration_limit': the levels above failed_level are "
      "optimal; 'not_finite': a row has NaN or infinity; 'bad_input': lower > "
      "upper or a negative weight. y is zero for the last two.");
  solution.def_property_readonly(
      "failed_level",
      [](const PythonSolution& self) { return self.solution.failed_level; },
      "The first level without an optimum, or -1.");
  solution.def_property_readonly(
      "iterations",
      [](const PythonSolution& self) { return self.solution.iterations; },
      "The number of factorisations, or updates of one.");
  solution.def_readonly("microseconds", &PythonSolution::microseconds,
                        "The time of the solver, us.");
  solution.def_readonly("modelled_seconds", &PythonSolution::modelled_seconds,
                        "The predicted time of the solve, s. It depends on the "
                        "work alone.");
  solution.def_property_readonly(
      "y",
      [](py::object self) {
        return View(self.cast<PythonSolution&>().solution.y, self);
      },
      "(n,) The optimum. Read-only, without a copy.");
  solution.def_property_readonly(
      "certificate",
      [](const PythonSolution& self) { return self.solution.certificate; },
      "The Certificate of the levels above failed_level, or of all.");
  solution.def_property_readonly(
      "gap", Gaps,
      "For each level, how far its cost may be above its optimum.");
  solution.def_property_readonly(
      "levels",
      [](const std::shared_ptr<PythonSolution>& self) {
        std::vector<PythonLevelSolution> levels;
        for (int i = 0; i < self->num_levels(); ++i) {
          levels.push_back({self, i});
        }
        return levels;
      },
      "The LevelSolution of each level.");
  solution.def_property_readonly(
      "multipliers",
      [](const std::shared_ptr<PythonSolution>& self) {
        py::list multipliers;
        for (int i = 0; i < self->num_levels(); ++i) {
          multipliers.append(Multipliers({self, i}));
        }
        return multipliers;
      },
      "multipliers[k][j]: multipliers of the rows of level j < k in the "
      "optimality condition of level k; see LevelSolution.multipliers.");
  solution.def_property_readonly(
      "active", ActiveRows,
      "The active inequalities: (level, row, 'lower' or 'upper').");
  solution.def("__repr__", [](const PythonSolution& self) {
    return "<poise.Solution, " + Name(self.solution.status) + ", " +
           Count(self.num_levels(), "level") + ">";
  });
  solution.def("explain", ExplainSolution,
               py::call_guard<py::gil_scoped_release>(),
               "Returns a text: the levels with their costs, the rows that are "
               "violated, and for each level the binding rows of the levels "
               "above, with their multipliers.");
  solution.def("conflict", Conflict, py::arg("level"),
               "Returns the names of a minimal set of rows, of this level and "
               "the levels above, that contradict each other; empty if the "
               "level is met. Solves one small problem a row.");
}

}  // namespace poise
