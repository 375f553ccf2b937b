// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/pybind11.h>

#include <stdexcept>

#include "poise/python/bind.h"
#include "poise/python/refuse_uninitialized.h"
#include "poise/python/text_signatures.h"

namespace {

// Makes poise.InputError, a ValueError. Each invalid input of Poise throws
// std::invalid_argument, see CONTRIBUTING.md.
void BindInputError(pybind11::module_* module) {
  static pybind11::exception<std::invalid_argument> error(*module, "InputError",
                                                          PyExc_ValueError);
  error.attr("__module__") = "poise";
  error.doc() =
      "An input that cannot be used: a wrong shape or type, or an invalid "
      "value or file. The message says which object, its value, and what was "
      "wanted.";
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const std::invalid_argument& invalid) {
      error(invalid.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_poise, module) {
  module.doc() = "The native part of the package poise.";
  BindInputError(&module);
  poise::BindSo3(&module);
  poise::BindSe3(&module);
  poise::BindTick(&module);
  poise::BindTree(&module);
  poise::BindDiagnosis(&module);
  poise::BindRobot(&module);
  poise::BindHierarchy(&module);
  poise::BindSolution(&module);
  poise::BindSolver(&module);
  poise::BindTask(&module);
  poise::BindController(&module);
  poise::BindScenario(&module);
  poise::BindSimulation(&module);
  poise::BindRun(&module);
  poise::RefuseUninitialized(module);
  poise::AddTextSignatures(module);
}
