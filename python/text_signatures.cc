// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/text_signatures.h"

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace poise {

namespace py = pybind11;

namespace {

// Returns the texts between the commas of a list, except commas within brackets
// or quotes. `end` becomes the index of the bracket that closes the list, or
// npos.
std::vector<std::string> SplitList(const std::string& text, std::size_t begin,
                                   std::size_t* end) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;  // The quotation mark that began a text, or 0 outside.
  *end = std::string::npos;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0 && c == '\\') {
      parts.back() += text.substr(i++, 2);
      continue;
    }
    if ((c == '\'' || c == '"') && (quote == 0 || quote == c)) {
      quote = quote == 0 ? c : '\0';
    }
    if (quote == 0 && depth == 0 && c == ')') {
      *end = i;
      break;
    }
    if (quote == 0 && std::strchr("([{", c) != nullptr) ++depth;
    if (quote == 0 && std::strchr(")]}", c) != nullptr) --depth;
    if (quote == 0 && depth == 0 && c == ',') {
      parts.emplace_back();
    } else if (c != ' ' || !parts.back().empty()) {
      parts.back() += c;
    }
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

// Returns the parameters of a signature by pybind11 without their types:
// "f(self: Tree, q: handle, dt: handle = 0.1) -> object" gives
// "(self, q, dt=0.1)". Returns "" if the text is no signature.
std::string ParametersOf(const std::string& signature) {
  const std::size_t open = signature.find('(');
  if (open == std::string::npos) return "";
  std::size_t end = 0;
  std::string parameters;
  for (const std::string& part : SplitList(signature, open + 1, &end)) {
    const std::size_t equals = part.find(" = ");
    if (!parameters.empty()) parameters += ", ";
    parameters += part.substr(0, part.find(':'));
    if (equals != std::string::npos)
      parameters += "=" + part.substr(equals + 3);
  }
  return end == std::string::npos ? "" : "(" + parameters + ")";
}

// Writes "NAME(PARAMETERS)\n--\n\n" in place of the first line of a docstring:
// the form in which CPython finds a signature.
void Rewrite(PyObject* function) {
  if (PyCFunction_Check(function) == 0) return;
  PyMethodDef* def = reinterpret_cast<PyCFunctionObject*>(function)->m_ml;
  if (def->ml_doc == nullptr) return;
  const std::string doc = def->ml_doc;
  const std::size_t line = doc.find('\n');
  const std::string parameters = ParametersOf(doc.substr(0, line));
  if (parameters.empty() || doc.find("\n--\n\n") != std::string::npos) return;
  const std::size_t text = doc.find_first_not_of('\n', line);
  const std::string made = def->ml_name + parameters + "\n--\n\n" +
                           (text == std::string::npos ? "" : doc.substr(text));
  // pybind11 frees ml_doc, which strdup() made.
  std::free(const_cast<char*>(def->ml_doc));
  def->ml_doc = strdup(made.c_str());
}

void RewriteClass(const py::handle& type) {
  for (const auto& [key, value] : py::dict(type.attr("__dict__"))) {
    if (PyInstanceMethod_Check(value.ptr()) != 0) {
      Rewrite(PyInstanceMethod_GET_FUNCTION(value.ptr()));
    } else if (py::isinstance<py::staticmethod>(value)) {
      Rewrite(py::object(value.attr("__func__")).ptr());
    }
  }
}

}  // namespace

void AddTextSignatures(const py::module_& module) {
  for (const auto& [key, value] : py::dict(module.attr("__dict__"))) {
    if (PyCFunction_Check(value.ptr()) != 0) {
      Rewrite(value.ptr());
    } else if (PyType_Check(value.ptr()) != 0) {
      RewriteClass(value);
    } else if (py::isinstance<py::module_>(value)) {
      AddTextSignatures(py::reinterpret_borrow<py::module_>(value));
    }
  }
}

}  // namespace poise
