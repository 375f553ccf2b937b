// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include "poise/python/arrays.h"

namespace poise {

/// Adds a property that shows a member of a class without a copy.
/// @param to  a pybind11::class_ of Class.
template <typename Class, typename Member, typename PythonClass>
void AddView(const char* name, Member Class::*member, const char* doc,
             PythonClass* to) {
  to->def_property_readonly(
      name,
      [member](py::object self) {
        return View(self.cast<Class&>().*member, self);
      },
      doc);
}

}  // namespace poise
