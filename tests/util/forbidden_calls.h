// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Counts what a control loop must not do, in this thread, while it lives:
/// throw (also if it is caught), lock (a mutex or other lock, also by trying, or
/// wait), write to a file or terminal, by the system's call or by stdio, as
/// streams do. For allocations there is CountMalloc.
///
/// Under a sanitizer, which has its own of these functions, nothing is seen.
class ForbiddenCalls {
 public:
  ForbiddenCalls();
  ~ForbiddenCalls();
  ForbiddenCalls(const ForbiddenCalls&) = delete;
  ForbiddenCalls& operator=(const ForbiddenCalls&) = delete;

  int throws() const;
  int locks() const;
  int writes() const;

  /// Whether calls are seen in this build.
  static bool IsSupported();
};

}  // namespace poise
