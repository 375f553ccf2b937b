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
  // NumPy converts arrays of one number, and complex numbers with a warning.
  const bool is_simple =
      PyFloat_Check(value.ptr()) != 0 || PyLong_Check(value.ptr()) != 0;
  const bool is_real =
      is_simple || (TypeName(value).rfind("complex", 0) != 0 &&
                    (!py::hasattr(value, "ndim") ||
                     py::object(value.attr("ndim")).equal(py::int_(0))));
  const double number = is_real ? PyFloat_AsDouble(value.ptr()) : -1;
  if (!is_real || (number == -1 && PyErr_Occurred() != nullptr)) {
    const bool is_large = PyErr_Occurred() != nullptr &&
                          PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a real number" +
                                (is_large ? " below 1.8e308" : ""));
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
  std::vector<std::string> texts;
  for (const py::handle text : AsList(value, name, "str")) {
    texts.push_back(AsText(text, name));
  }
  return texts;
}

py::list AsList(py::handle value, const char* name, const char* of) {
  const bool is_text =
      py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value);
  PyObject* list = is_text || PySequence_Check(value.ptr()) == 0
                       ? nullptr
                       : PySequence_List(value.ptr());
  if (list == nullptr) {  // For example, an array of NumPy without dimensions.
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a list of " + of);
  }
  return py::reinterpret_steal<py::list>(list);
}

}  // namespace poise
