// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/refuse_uninitialized.h"

#include <cstddef>
#include <stdexcept>

namespace poise {

namespace py = pybind11;

namespace {

// pybind11 allocates the value of an object when a function first reads it, if
// no constructor has made it before.
void* Refuse(std::size_t) {
  throw std::invalid_argument(
      "the object was not initialized: call __init__() of its class before its "
      "members");
}

}  // namespace

void RefuseUninitialized(const py::module_& module) {
  for (const auto& [name, value] : py::dict(module.attr("__dict__"))) {
    if (PyType_Check(value.ptr()) == 0) continue;
    auto* type = reinterpret_cast<PyTypeObject*>(value.ptr());
    py::detail::type_info* info = py::detail::get_type_info(type);
    if (info != nullptr) info->operator_new = Refuse;
  }
}

}  // namespace poise
