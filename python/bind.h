// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

namespace poise {

// Each function adds one concept to the module poise._poise. A class must be
// added before functions that return it, so that signatures in docstrings have
// its Python name.
void BindSo3(pybind11::module_* module);
void BindSe3(pybind11::module_* module);
void BindTick(pybind11::module_* module);
void BindTree(pybind11::module_* module);
void BindDiagnosis(pybind11::module_* module);
void BindRobot(pybind11::module_* module);
void BindHierarchy(pybind11::module_* module);
void BindSolution(pybind11::module_* module);
void BindSolver(pybind11::module_* module);
void BindTask(pybind11::module_* module);
void BindController(pybind11::module_* module);
void BindScenario(pybind11::module_* module);
void BindSimulation(pybind11::module_* module);
void BindRun(pybind11::module_* module);

}  // namespace poise
