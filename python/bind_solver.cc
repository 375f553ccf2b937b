// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "poise/hqp/solver.h"
#include "poise/python/arguments.h"
#include "poise/python/as_object.h"
#include "poise/python/bind.h"
#include "poise/python/exclusive.h"
#include "poise/python/python_solution.h"
#include "poise/python/text.h"

namespace poise {

namespace py = pybind11;

namespace {

// A solver that allocates memory for larger hierarchies when it gets them.
class PythonSolver {
 public:
  explicit PythonSolver(int n) : n_(n) {}

  std::shared_ptr<PythonSolution> Solve(const PythonHierarchy& hierarchy) {
    if (hierarchy.num_variables != n_) {
      throw std::invalid_argument(
          "hierarchy has " + std::to_string(hierarchy.num_variables) +
          " variables, must have " + std::to_string(n_));
    }
    const Exclusive exclusive(&in_use_, "this Solver");
    // Another thread may change these three once the lock is released.
    PythonHierarchy problem = hierarchy;
    const int most = max_iterations;
    const double longest = max_modelled_seconds;
    const py::gil_scoped_release release;
    Reserve(SizesOf(problem));
    CopyRows(problem, &*rows_);
    auto solved = std::make_shared<PythonSolution>(std::move(problem));
    solver_->max_iterations = most;
    solver_->max_modelled_seconds = longest;
    const auto start = std::chrono::steady_clock::now();
    (void)solver_->Solve(*rows_, &solved->solution);
    solved->microseconds = std::chrono::duration<double, std::micro>(
                               std::chrono::steady_clock::now() - start)
                               .count();
    solved->modelled_seconds = solver_->modelled_seconds();
    return solved;
  }

  void Forget() {
    const Exclusive exclusive(&in_use_, "this Solver");
    if (solver_) solver_->Forget();
  }

  int n() const { return n_; }

  int max_iterations = 10000;
  double max_modelled_seconds = 0;

 private:
  // Makes a new solver, which starts cold, if a level is larger than before.
  void Reserve(const std::vector<LevelCapacity>& sizes) {
    bool fits = solver_.has_value() && rows_.has_value() &&
                sizes.size() <= capacity_.size();
    capacity_.resize(std::max(capacity_.size(), sizes.size()));
    for (size_t level = 0; level < sizes.size(); ++level) {
      LevelCapacity& most = capacity_[level];
      fits = fits && sizes[level].equalities <= most.equalities &&
             sizes[level].inequalities <= most.inequalities;
      most.equalities = std::max(most.equalities, sizes[level].equalities);
      most.inequalities =
          std::max(most.inequalities, sizes[level].inequalities);
    }
    if (fits) return;
    solver_.emplace(n_, capacity_);
    rows_.emplace(n_, capacity_);
  }

  int n_;
  std::vector<LevelCapacity> capacity_;
  std::optional<Solver> solver_;
  std::optional<Hierarchy> rows_;  // The rows of the last solve.
  InUse in_use_;
};

}  // namespace

void BindSolver(py::module_* module) {
  py::class_<PythonSolver> solver(
      *module, "Solver",
      "The hierarchical active-set solver. Each solve starts from the working "
      "set and y of the last one. A hierarchy with more levels or rows than "
      "any before starts cold."
      "\n\n"
      ">>> hierarchy = poise.Hierarchy(1)\n"
      ">>> hierarchy.add_level(name='limit', C=[[1]], upper=[1])\n"
      ">>> hierarchy.add_level(name='target', B=[[1]], b=[-3])\n"
      ">>> solution = poise.Solver(1).solve(hierarchy)\n"
      ">>> solution.status, solution.active, solution.certificate.worst < "
      "1e-9\n"
      "('optimal', [(0, 0, 'upper')], True)\n"
      ">>> solution.conflict(1)\n"
      "[\"level 0 'limit', row 0 of C\", \"level 1 'target', row 0 of B\"]\n");
  solver.def(
      py::init([](py::handle n) {
        constexpr int kMost = 100000;
        return std::make_unique<PythonSolver>(AsInteger(n, "n", 0, kMost));
      }),
      py::arg("n"), "Makes a solver for hierarchies in n variables.");
  solver.def_property_readonly("n", &PythonSolver::n,
                               "The number of variables.");
  solver.def("__repr__", [](const PythonSolver& self) {
    return "<poise.Solver, " + Count(self.n(), "variable") + ">";
  });
  solver.def_property(
      "max_iterations",
      [](const PythonSolver& self) { return self.max_iterations; },
      [](PythonSolver& self, py::handle value) {
        self.max_iterations = AsInteger(value, "max_iterations", 1,
                                        std::numeric_limits<int>::max());
      },
      "The largest number of factorisations of a solve.");
  solver.def_property(
      "max_modelled_seconds",
      [](const PythonSolver& self) { return self.max_modelled_seconds; },
      [](PythonSolver& self, py::handle value) {
        self.max_modelled_seconds =
            AsNotNegative(value, "max_modelled_seconds");
      },
      "The limit of the predicted time of a solve, s; 0: no limit. After a "
      "solve that was cut off, the next one goes on from there.");
  solver.def(
      "solve",
      [](PythonSolver& self, py::handle hierarchy) {
        return self.Solve(AsObject<PythonHierarchy>(hierarchy, "hierarchy"));
      },
      py::arg("hierarchy"),
      "Solves a Hierarchy and returns its Solution. Copies the rows. Other "
      "threads run meanwhile, but must not use this solver.");
  solver.def("forget", &PythonSolver::Forget,
             "Forgets the last solve: the next one starts cold.");
}

}  // namespace poise
