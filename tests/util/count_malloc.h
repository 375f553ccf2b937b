// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Counts the heap allocations of this thread while it lives.
///
///     CountMalloc count;
///     Control(...);  // No allocation allowed from here ...
///     EXPECT_EQ(count.allocations(), 0);
///
/// Under a sanitizer, which brings its own malloc(), the count stays 0.
class CountMalloc {
 public:
  CountMalloc();
  ~CountMalloc();
  CountMalloc(const CountMalloc&) = delete;
  CountMalloc& operator=(const CountMalloc&) = delete;

  int allocations() const;

  /// Whether allocations are seen in this build.
  static bool IsSupported();
};

}  // namespace poise
