// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

namespace poise {

/// Forgets what an earlier call of this thread has left that failed before
/// RaiseInterrupt(). Call with Python's lock, before the ticks.
void ForgetInterrupt();

/// Remembers an exception that must end the whole call of this thread, such as
/// KeyboardInterrupt in the rows() of a task: a tick cannot throw. Call with
/// Python's lock.
void RememberInterrupt(const pybind11::error_already_set& error);

/// Throws what this thread has remembered, if anything. Call with Python's
/// lock, after the ticks.
void RaiseInterrupt();

/// Looks for Ctrl-C in a loop of ticks that runs without Python's lock. The
/// lock is taken at most once in 50 ticks, because each time costs up to 5 ms
/// beside a busy thread: Python's switch interval.
class InterruptCheck {
 public:
  /// Returns whether the loop must end; then call RaiseInterrupt().
  /// @param ticks  the number of ticks up to now.
  bool Look(long ticks);

 private:
  long last_ = 0;
};

}  // namespace poise
