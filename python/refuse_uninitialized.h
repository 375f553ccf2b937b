// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

namespace poise {

/// Makes the members of an object whose __init__() was not called raise
/// poise.InputError, for all classes of a module. Without this, pybind11 gives
/// them memory that was never set: poise.Robot.__new__(poise.Robot).name would
/// crash Python.
void RefuseUninitialized(const pybind11::module_& module);

}  // namespace poise
