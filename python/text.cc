// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/text.h"

#include <pybind11/pybind11.h>

namespace poise {

namespace py = pybind11;

std::string Count(std::ptrdiff_t number, const std::string& singular,
                  const std::string& plural) {
  const std::string many = plural.empty() ? singular + "s" : plural;
  return std::to_string(number) + " " + (number == 1 ? singular : many);
}

std::string Repr(const std::string& text) {
  return py::cast<std::string>(py::repr(py::str(text)));
}

}  // namespace poise
