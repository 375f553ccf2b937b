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

namespace {

// Forgets an exception of Python, for which the caller throws another one.
// Ctrl-C and the like are thrown instead.
void ForgetError() {
  if (PyErr_Occurred() == nullptr) return;
  if (PyErr_ExceptionMatches(PyExc_Exception) == 0) {
    throw py::error_already_set();
  }
  PyErr_Clear();
}

// Returns whether a value of NumPy is one real number.
bool IsRealScalar(py::handle value) {
  const std::string kind =
      py::str(py::getattr(value.attr("dtype"), "kind", py::str("?")));
  const std::string ndim = py::str(py::getattr(value, "ndim", py::str("?")));
  return ndim == "0" && kind.size() == 1 &&
         kind.find_first_of("biuf") != std::string::npos;
}

}  // namespace

double AsNumber(py::handle value, const char* name) {
  // NumPy converts arrays of one number, texts of one, and complex numbers.
  const bool is_number = PyFloat_Check(value.ptr()) != 0 ||
                         PyLong_Check(value.ptr()) != 0 ||
                         !py::hasattr(value, "dtype") || IsRealScalar(value);
  const double number = is_number ? PyFloat_AsDouble(value.ptr()) : -1;
  if (is_number && (number != -1 || PyErr_Occurred() == nullptr)) return number;
  const bool is_large = PyErr_Occurred() != nullptr &&
                        PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
  ForgetError();
  throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                              " of type " + TypeName(value) +
                              ", must be a real number" +
                              (is_large ? " of magnitude below 1.8e308" : ""));
}

double AsNotNegative(py::handle value, const char* name) {
  const double number = AsNumber(value, name);
  if (number >= 0) return number;
  throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                              ", must be 0 or more");
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
    ForgetError();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a str or a path that is one");
  }
  Py_ssize_t size = 0;
  const char* utf8 = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (utf8 == nullptr) {  // Half of a surrogate pair.
    ForgetError();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                ", must be valid Unicode");
  }
  return std::string(utf8, size);
}

std::vector<std::string> AsTexts(py::handle value, const char* name) {
  const bool is_text =
      py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value);
  const auto list = py::reinterpret_steal<py::object>(
      is_text || PySequence_Check(value.ptr()) == 0
          ? nullptr
          : PySequence_List(value.ptr()));
  if (!list) {  // For example, an array of NumPy without dimensions.
    ForgetError();
    throw std::invalid_argument(std::string(name) + " is " + Shown(value) +
                                " of type " + TypeName(value) +
                                ", must be a list of str");
  }
  std::vector<std::string> texts;
  for (const py::handle text : list) texts.push_back(AsText(text, name));
  return texts;
}

}  // namespace poise
