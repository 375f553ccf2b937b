// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include "poise/python/arrays.h"

namespace poise {

/// Adds a function of one argument that returns an array.
/// @param kRead  reads the argument: AsVector3(), AsPose(), ...
template <auto kRead, typename Function>
void AddFunction(const char* name, const char* argument, Function function,
                 const char* doc, py::module_* to) {
  to->def(
      name,
      [function, argument](py::handle value) {
        return ToArray(function(kRead(value, argument)));
      },
      py::arg(argument), doc);
}

}  // namespace poise
