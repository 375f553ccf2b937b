// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/arguments.h"

#include <cmath>
#include <stdexcept>

namespace poise {

namespace py = pybind11;

std::string Shown(py::handle value) {
  constexpr Py_ssize_t kMost = 60;
  const py::str text = py::repr(value);
  if (PyUnicode_GetLength(text.ptr()) <= kMost)
    return py::cast<std::string>(text);
  // By characters: a cut inside one would not be valid UTF-8.
  const auto start =
      py::reinterpret_steal<py::str>(PyUnicode_Substring(text.ptr(), 0, kMost));
  return py::cast<std::string>(start) + "...";
}

std::string TypeName(py::handle value) {
  return py::cast<std::string>(py::type::handle_of(value).attr("__name__"));
}

double AsNumber(py::handle value, const char* name) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a real number");
  }
  return number;
}

int AsInteger(py::handle value, const char* name, int lower, int upper) {
  const double number = AsNumber(value, name);
  if (!(number >= lower && number <= upper && number == std::floor(number))) {
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                ", must be a whole number from " +
                                std::to_string(lower) + " to " +
                                std::to_string(upper));
  }
  return static_cast<int>(number);
}

bool AsFlag(py::handle value, const char* name) {
  // The type of NumPy is compared by its name, so that NumPy is not loaded.
  const std::string type = TypeName(value);
  if (!py::isinstance<py::bool_>(value) && type != "bool_") {
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + type + ", must be True or False");
  }
  return PyObject_IsTrue(value.ptr()) == 1;
}

std::string AsText(py::handle value, const char* name) {
  if (!py::isinstance<py::str>(value) && !py::hasattr(value, "__fspath__")) {
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a str");
  }
  const auto text = py::reinterpret_steal<py::object>(PyOS_FSPath(value.ptr()));
  if (!text || !py::isinstance<py::str>(text)) {  // For example, bytes.
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a str or a path that is one");
  }
  Py_ssize_t size = 0;
  const char* utf8 = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (utf8 == nullptr) {  // Half of a surrogate pair.
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                ", must be valid Unicode");
  }
  return std::string(utf8, size);
}

std::vector<std::string> AsTexts(py::handle value, const char* name) {
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) {
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a list of str");
  }
  std::vector<std::string> texts;
  for (const py::handle text : value) texts.push_back(AsText(text, name));
  return texts;
}

}  // namespace poise
