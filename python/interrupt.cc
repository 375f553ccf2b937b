// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/interrupt.h"

#include <memory>

namespace poise {

namespace py = pybind11;

namespace {

// Empty between two calls of Python, unless the first one failed.
thread_local std::unique_ptr<py::error_already_set> remembered;

}  // namespace

void ForgetInterrupt() { remembered.reset(); }

void RememberInterrupt(const py::error_already_set& error) {
  remembered = std::make_unique<py::error_already_set>(error);
}

void RaiseInterrupt() {
  if (!remembered) return;
  const py::error_already_set error = *remembered;
  remembered.reset();
  throw error;
}

bool InterruptCheck::Look(long ticks) {
  constexpr long kBetween = 50;
  if (ticks - last_ >= kBetween) {
    last_ = ticks;
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) RememberInterrupt(py::error_already_set());
  }
  return remembered != nullptr;
}

}  // namespace poise
