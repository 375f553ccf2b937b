// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Counts calls of this thread that a control loop must not make, during the
/// object's lifetime:
/// - throw, also if the exception is caught;
/// - lock a mutex or other lock, also by a try or a wait;
/// - write to a file or terminal, by system call or by stdio (streams use it).
///
/// CountMalloc counts allocations. Under a sanitizer, which replaces these
/// functions by its own, all counts stay 0.
class ForbiddenCalls {
 public:
  ForbiddenCalls();
  ~ForbiddenCalls();
  ForbiddenCalls(const ForbiddenCalls&) = delete;
  ForbiddenCalls& operator=(const ForbiddenCalls&) = delete;

  int throws() const;
  int locks() const;
  int writes() const;

  /// Returns whether this build can count calls.
  static bool IsSupported();
};

}  // namespace poise
