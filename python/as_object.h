// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>

#include "poise/python/arguments.h"

namespace poise {

/// Returns an argument that is an object of a bound class. Throws
/// std::invalid_argument, which Python sees as poise.InputError, if the
/// argument has another type.
template <typename Class>
Class& AsObject(pybind11::handle value, const char* name) {
  if (!pybind11::isinstance<Class>(value)) {
    throw std::invalid_argument(
        std::string(name) + " is of type " + TypeName(value) + ", must be a " +
        pybind11::cast<std::string>(
            pybind11::type::of<Class>().attr("__name__")));
  }
  return value.cast<Class&>();
}

}  // namespace poise
