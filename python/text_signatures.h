// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

namespace poise {

/// Gives the functions and methods of a module, and those of its modules, a
/// signature that inspect.signature() and help() read. The one of pybind11,
/// the first line of a docstring, names types of C++: "q: handle". The stubs
/// have the types.
void AddTextSignatures(const pybind11::module_& module);

}  // namespace poise
