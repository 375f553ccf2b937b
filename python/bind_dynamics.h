// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "poise/python/python_tree.h"

namespace poise {

using TreeClass = pybind11::class_<PythonTree, std::shared_ptr<PythonTree>>;

/// Adds the classes of the results of the methods below.
void BindDynamicsResults(pybind11::module_* module);

// Each function adds methods to the class Tree.
void AddEquationOfMotion(TreeClass* tree);  ///< rnea, crba, aba, bias.
void AddKinematics(TreeClass* tree);        ///< jacobian, pose, integrate.
void AddMomentum(TreeClass* tree);          ///< com, centroidal, energies.
void AddDerivatives(TreeClass* tree);       ///< derivatives, regressor.
void AddTick(TreeClass* tree);              ///< tick.
void AddConventions(TreeClass* tree);       ///< export_..., import_....

}  // namespace poise
